#include "talus/scene/build.h"

#include <algorithm>

#include "talus/scene/build_context.h"

namespace talus {
namespace {

// How deep the lowest stones sit in the ground, as a share of a tile cell: nothing stands on
// points.
constexpr double kSunkShare = 0.25;

// Adds the instances of `more`, whose prototypes follow those already there.
void append(InstanceTable& table, InstanceTable more) {
  const auto offset = static_cast<std::uint32_t>(table.prototypes.size());
  for (Instance& instance : more.instances) instance.prototype += offset;
  table.prototypes.insert(table.prototypes.end(), more.prototypes.begin(), more.prototypes.end());
  table.instances.insert(table.instances.end(), more.instances.begin(), more.instances.end());
}

}  // namespace

std::string_view version() { return TALUS_VERSION; }

BuildResult build(const Recipe& recipe, const BuildParams& params, Job* job) {
  BuildContext context{.cache = Cache(params.cache_folder, params.cache_bytes_max),
                       .job = job,
                       .result = {.recipe = recipe}};
  for (const Operation& operation : recipe.operations) {
    check_cancelled(job);
    std::visit([&](const auto& o) { run(o, context); }, operation);
  }

  const StageTimer timer;
  BuildResult& result = context.result;
  for (const NamedPile& named : result.piles) {
    append(result.stones, instances(named.pile));
    const double ground = named.pile.origin.z + kSunkShare * named.pile.cell_size;
    result.ground = std::min(result.ground.value_or(ground), ground);
  }
  result.stages.push_back(timer.stop("assemble"));
  return std::move(context.result);
}

MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, const BuildParams& build_params,
                     Job* job) {
  Cache cache(build_params.cache_folder, build_params.cache_bytes_max);
  return make_tiles(params, seed, cache, job);
}

}  // namespace talus
