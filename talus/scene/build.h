// From a recipe to a scene in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/stage.h"
#include "talus/io/raster_reader.h"
#include "talus/mesh/instance_table.h"
#include "talus/piles/pile.h"
#include "talus/rocks/tile_set.h"
#include "talus/scene/recipe.h"
#include "talus/terrain/ground_mesh.h"
#include "talus/terrain/layered_terrain.h"
#include "talus/terrain/ledger.h"
#include "talus/terrain/water_surface.h"

namespace talus {

// Of the library, for example "0.1.0".
std::string_view version();

// Three quarters of the machine's memory.
std::uint64_t default_memory_limit();

struct BuildParams {
  std::optional<std::filesystem::path> cache_folder;  // none: every stage is made anew
  std::uintmax_t cache_bytes_max = std::uintmax_t{4} << 30;
  std::uint64_t memory_limit = default_memory_limit();  // bytes that terrain and mesh may take
};

// The scene's terrain and what is drawn of it.
struct TerrainResult {
  LayeredTerrain terrain;
  std::vector<LedgerEntry> ledger;  // one entry for each operation on it
  Georeference georeference;        // of the raster that set its extent
  GroundMesh ground;
  TriangleMesh water;  // positions relative to the ground's origin
};

// One pile of the scene, by the name its operation gives it.
struct NamedPile {
  std::string name;
  Pile pile;
  bool in_terrain = false;  // fills layers of the terrain, else stands on the plane
  std::string key;          // fingerprint of all it came from
};

struct BuildResult {
  Recipe recipe;
  std::optional<TerrainResult> terrain;
  std::vector<std::shared_ptr<const TileSet>> tile_sets;  // each once, in order of first use
  std::vector<NamedPile> piles;                           // in the recipe's order
  InstanceTable stones;                                   // of all piles
  std::optional<double> plane;  // height of the plane that a scene without terrain stands on
  std::vector<std::string> idle_operations;  // places of those that left the terrain as it was
  std::vector<Stage> stages;
};

// Runs the operations in order. The scene is a function of recipe, input files and version alone:
// threads and cache change only the stages' costs. Throws what the operations throw: `Error`
// (usage) for values out of range for an input, `Error` (input) for unusable files, both beginning
// with the operation's place if it has one; `Cancelled`.
BuildResult build(const Recipe& recipe, const BuildParams& params = {}, Job* job = nullptr);

// The tile set of those parameters, with its stage, from the cache if there.
struct MadeTiles {
  std::shared_ptr<const TileSet> tiles;
  Stage stage;
};
MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, const BuildParams& build = {},
                     Job* job = nullptr);

}  // namespace talus
