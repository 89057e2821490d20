#include "talus/scene/build.h"

#include <unistd.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "talus/scene/build_context.h"

namespace talus {
namespace {

// How deep the lowest stones sit in the ground, as a share of a tile cell: nothing stands on
// points.
constexpr double kSunkShare = 0.25;

// All piles in one table: a mesh that several share is one prototype.
InstanceTable joined(const std::vector<NamedPile>& piles) {
  InstanceTable table;
  std::unordered_map<const TriangleMesh*, std::uint32_t> known;  // only looked up, never iterated
  for (const NamedPile& named : piles) {
    InstanceTable more = instances(named.pile);
    std::vector<std::uint32_t> prototype;
    for (std::shared_ptr<const TriangleMesh>& mesh : more.prototypes) {
      const auto next = static_cast<std::uint32_t>(table.prototypes.size());
      const auto [entry, is_new] = known.try_emplace(mesh.get(), next);
      if (is_new) table.prototypes.push_back(std::move(mesh));
      prototype.push_back(entry->second);
    }
    for (Instance& instance : more.instances) {
      instance.prototype = prototype[instance.prototype];
      instance.name.pile = static_cast<std::uint16_t>(&named - piles.data());
    }
    table.instances.insert(table.instances.end(), more.instances.begin(), more.instances.end());
  }
  std::stable_sort(table.instances.begin(), table.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; });
  return table;
}

// Stones have places of their own from here on: as they are told one by one, joined and sorted.
void check_memory(const std::vector<NamedPile>& piles, std::uint64_t memory_limit) {
  constexpr double kCopies = 3;
  double stones = 0;
  for (const NamedPile& named : piles) stones += static_cast<double>(named.pile.stats.instances);
  const double bytes = kCopies * sizeof(Instance) * stones;
  if (bytes > static_cast<double>(memory_limit))
    throw job_error(fmt::format(
        "{:.0f} stones need about {:.2g} GB to be written; the memory limit is {:.2g} GB; give "
        "larger stones, or surface_only, or a higher limit",
        stones, bytes / 1e9, static_cast<double>(memory_limit) / 1e9));
}

// The base of the lowest support, a little raised; higher if no stone would reach it.
std::optional<double> plane_under(const BuildResult& result) {
  if (result.piles.empty() || result.terrain) return std::nullopt;
  const auto height = [](const NamedPile& named) {
    return named.pile.floor + kSunkShare * named.pile.tiling.cell_size;
  };
  const auto lowest = std::min_element(
      result.piles.begin(), result.piles.end(),
      [&](const NamedPile& a, const NamedPile& b) { return height(a) < height(b); });
  return std::max(height(*lowest),
                  bounds(result.stones).min.z + kSunkShare * lowest->pile.tiling.cell_size);
}

// Does something for an operation. What goes wrong is told with the place in the recipe.
void at_place(const Operation& operation, auto&& task) {
  try {
    task();
  } catch (const Error& error) {
    if (operation.where.empty()) throw;
    throw Error(error.kind(), told_at(place_of(operation), error.what()));
  }
}

// Runs one operation. Later it is told if nothing happened.
void run(const Operation& operation, BuildContext& context) {
  const auto booked = [&] { return context.terrain ? context.terrain->ledger.size() : 0; };
  const std::size_t booked_before = booked();
  at_place(operation, [&] {
    std::visit([&](const auto& params) { run(params, context); }, operation.params);
  });
  if (booked() > booked_before && context.terrain->ledger.back().booking == Booking{})
    context.result.idle_operations.push_back(place_of(operation));
}

}  // namespace

std::uint64_t default_memory_limit() {
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || page_bytes <= 0) return std::uint64_t{4} << 30;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes) / 4 * 3;
}

std::string_view version() { return TALUS_VERSION; }

BuildResult build(const Recipe& recipe, const BuildParams& params, Job* job) {
  BuildContext context{.cache = Cache(params.cache_folder, params.cache_bytes_max),
                       .memory_limit = params.memory_limit,
                       .job = job,
                       .result = {.recipe = recipe}};
  if (const std::optional<TerrainGrid> grid = known_grid(recipe))
    for (const Operation& operation : recipe.operations)
      at_place(operation, [&] { check_places(operation, *grid); });
  for (const Operation& operation : recipe.operations) {
    check_cancelled(job);
    run(operation, context);
  }
  finish_terrain(context);

  const StageTimer timer;
  BuildResult& result = context.result;
  check_memory(result.piles, params.memory_limit);
  result.stones = joined(result.piles);
  result.plane = plane_under(result);
  result.stages.push_back(timer.stop("assemble"));
  return std::move(context.result);
}

MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, const BuildParams& build_params,
                     Job* job) {
  Cache cache(build_params.cache_folder, build_params.cache_bytes_max);
  return make_tiles(params, seed, cache, job);
}

}  // namespace talus
