// Promise: the stones of a recipe are chosen in a tenth of a second, tiles at hand.
#include "bench/measure.h"
#include "talus/base/parallel.h"
#include "talus/scene/build_context.h"

namespace talus {
namespace {

using bench::Bound;

// All piles of a scene, its terrain and tile sets at hand.
void pile_scene(benchmark::State& state, const char* scene) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const Recipe recipe =
      load_recipe(std::filesystem::path(TALUS_SCENES) / (std::string(scene) + ".toml"));
  BuildContext context{.cache = Cache(default_cache_folder(), std::uintmax_t{4} << 30),
                       .memory_limit = default_memory_limit(),
                       .result = {.recipe = recipe}};
  const auto run_piles = [&](bool piles) {
    for (const Operation& operation : recipe.operations)
      std::visit(
          [&](const auto& op) {
            if (std::is_same_v<std::remove_cvref_t<decltype(op)>, PileOperation> == piles)
              run(op, context);
          },
          operation.params);
  };
  run_piles(false);
  run_piles(true);
  context.cache = Cache({}, 0);
  const Bound bound(state, 0.1);
  for (auto _ : state) {
    context.result.piles.clear();
    run_piles(true);
    std::uint64_t stones = 0;
    for (const NamedPile& named : context.result.piles) stones += named.pile.stats.instances;
    state.counters["stones"] = static_cast<double>(stones);
  }
}
BENCHMARK_CAPTURE(pile_scene, canyon, "canyon")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pile_scene, zen_garden, "zen_garden")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pile_scene, borie, "borie")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pile_scene, statue, "statue")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
