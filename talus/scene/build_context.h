// What the operations of one build share.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "talus/scene/build.h"
#include "talus/scene/cache.h"

namespace talus {

struct BuildContext {
  Cache cache;
  Job* job = nullptr;
  BuildResult result;
  std::map<std::string, std::shared_ptr<const TileSet>> tile_sets;  // by cache key
};

// Runs one operation: adds to `context.result`. Throws as `build`.
void run(const PileOperation& operation, BuildContext& context);

// The tile set and how it was come by.
MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, Cache& cache, Job* job);

// Fingerprint of a tile set's parameters, seed and version.
std::string tile_key(const TileParams& params, std::uint64_t seed);

}  // namespace talus
