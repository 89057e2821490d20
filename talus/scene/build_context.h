// What the operations of one build share.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "talus/base/hash.h"
#include "talus/scene/build.h"
#include "talus/scene/cache.h"

namespace talus {

// The terrain while operations work on it.
struct TerrainState {
  LayeredTerrain terrain;
  std::string key;  // fingerprint of everything it came from
  std::vector<LedgerEntry> ledger;
  Georeference georeference;
};

struct BuildContext {
  Cache cache;
  std::uint64_t memory_limit = 0;
  Job* job = nullptr;
  BuildResult result;
  std::optional<TerrainState> terrain;
  std::map<std::string, std::shared_ptr<const TileSet>> tile_sets;  // by cache key
};

// Runs one operation: adds to `context.result`. Throws as `build`.
void run(const HeightmapOperation& operation, BuildContext& context);
void run(const NoiseTerrainOperation& operation, BuildContext& context);
void run(const PrimitiveOperation& operation, BuildContext& context);
void run(const MeshBedrockOperation& operation, BuildContext& context);
void run(const CoverOperation& operation, BuildContext& context);
void run(const SculptOperation& operation, BuildContext& context);
void run(const SweepOperation& operation, BuildContext& context);
void run(const DepositOperation& operation, BuildContext& context);
void run(const ErodeSurfaceOperation& operation, BuildContext& context);
void run(const PileOperation& operation, BuildContext& context);

// The terrain's columns as far as the recipe alone tells; none if a raster does. The floor is open.
std::optional<TerrainGrid> known_grid(const Recipe& recipe);

// Throws `Error` (usage) for a stroke or path outside the terrain: nothing needs to be made to find
// it.
void check_places(const Operation& operation, const TerrainGrid& grid);

// Meshes the terrain, if there is one, once all operations have run.
void finish_terrain(BuildContext& context);

// The values of all fields, defaults too, so that a changed default changes the key.
template <Described T>
void add_params(Digest& digest, const T& params) {
  for (const KeyHelp& key : list_keys(params)) {
    digest.add(key.path);
    digest.add(key.default_value);
  }
}

// The tile set and how it was come by.
MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, Cache& cache, Job* job);

// Fingerprint of a tile set's parameters, seed and version.
std::string tile_key(const TileParams& params, std::uint64_t seed);

}  // namespace talus
