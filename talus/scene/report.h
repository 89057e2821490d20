// What was made, what it cost and whether it is sound.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/scene/build.h"
#include "talus/scene/tile_report.h"

namespace talus {

struct StoneReport {
  std::uint64_t instances = 0;
  std::uint64_t unique = 0;    // of the tile sets' stones
  std::uint64_t floating = 0;  // held by no chain of contacts down to their pile's lowest cells
  double bytes_per_stone = 0;  // of the piles in memory
};

// One pile by its operation's name.
struct PileReport {
  std::string name;
  std::uint64_t instances = 0;
  std::uint64_t hidden = 0;
  std::uint64_t isolated = 0;
  std::uint64_t thinned = 0;
  double gap_fraction = 0;  // of what is to be filled, because no whole stone fits there
};

struct TerrainReport {
  std::uint64_t columns = 0;
  std::uint64_t layers = 0;
  std::uint64_t bytes = 0;
  double bytes_per_column = 0;
  double bytes_per_layer = 0;
  double step_m = 0;
  std::array<double, 2> size_m{};  // extent to the east and to the north
  double cell_m = 0;
  std::string crs;                  // of the raster that set the extent; empty if unknown
  std::array<double, 2> offset{};   // what to add to x and y for coordinates in `crs`
  MaterialSteps volume_steps{};     // by material
  double mesh_deviation_max_m = 0;  // between the ground mesh and the tops of ground in the columns
  double mesh_deviation_p99_m = 0;  // what 99 % of the columns do not exceed
  double mesh_deviation_mean_m = 0;
  std::uint64_t mesh_columns_lost = 0;  // whose top the ground mesh misses: too thin for it
};

struct MeshReport {
  std::uint64_t triangles = 0;  // each mesh counted once
  std::uint64_t vertices = 0;
  bool closed = true;
  bool manifold = true;
  bool oriented = true;
};

struct Check {
  std::string name;
  bool ok = false;
  std::string detail;
};

// Sections that do not apply are absent. `hash` covers columns, tile sets, instances and meshes: it
// is the same for any number of threads and any run of one build of the library.
struct Report {
  std::string talus;   // version
  std::string recipe;  // as TOML, files relative to the report; empty for a tile set alone
  std::uint64_t seed = 0;
  int threads = 0;
  std::string hash;
  std::vector<Stage> stages;
  std::optional<TerrainReport> terrain;
  std::vector<LedgerEntry> ledger;  // one entry for each operation on the terrain, in order
  std::optional<TileReport> tiles;
  std::optional<StoneReport> stones;
  std::vector<PileReport> piles;  // in the recipe's order
  std::vector<std::pair<std::string, MeshReport>> meshes;
  std::vector<Check> checks;
};

// Examines every mesh that is drawn; parallel. The report is meant to lie in `folder`.
Report make_report(const BuildResult& result, const std::filesystem::path& folder = {});
Report make_report(const MadeTiles& made);

// JSON with the keys of the fields, in their order, indented.
std::string to_json(const Report& report);

// The recipe of a report file, ready to be built again, after `change` has set values in it. Throws
// `Error` (input) if the file is missing or no report of a scene, else as `read_recipe`.
Recipe load_reported_recipe(const std::filesystem::path& file,
                            const std::function<Value(Value)>& change = std::identity());

}  // namespace talus
