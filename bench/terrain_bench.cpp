// Promise: a landscape of layers takes at most 4 bytes a layer and 2.4 bytes a column.
#include <benchmark/benchmark.h>

#include <vector>

#include "bench/terrain_scene.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/settle/layer_order.h"
#include "talus/terrain/layer_support.h"

namespace talus::bench {
namespace {

// Packs columns that are ready, so that making them up is not timed.
void pack(benchmark::State& state, int nx, int ny) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const LayeredTerrain& scene = cave_scene(nx, ny);
  const LayeredTerrain empty(scene.grid());
  for (auto _ : state) {
    LayeredTerrain terrain = empty;
    terrain.edit([&](int x, int y, ColumnEditor& column) {
      Steps bottom = scene.grid().floor;
      for (const Layer& layer : scene.column(x, y)) {
        column.replace(bottom, layer.top(), layer.material());
        bottom = layer.top();
      }
    });
    benchmark::DoNotOptimize(terrain);
  }
  const auto bytes = static_cast<double>(scene.bytes());
  const auto columns = static_cast<double>(scene.column_count());
  const auto layers = static_cast<double>(scene.layer_count());
  state.counters["MB"] = bytes / 1e6;
  state.counters["layers_per_column"] = layers / columns;
  state.counters["bytes_per_column"] = bytes / columns;
  state.counters["bytes_per_layer"] = bytes / layers;
  state.counters["of_bound"] = bytes / (4 * layers + 2.4 * columns);
}

void columns_pack(benchmark::State& state) { pack(state, kSceneX, kSceneY); }
BENCHMARK(columns_pack)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void columns_small(benchmark::State& state) { pack(state, 100, 75); }
BENCHMARK(columns_small)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

void columns_copy(benchmark::State& state) {
  const LayeredTerrain& scene = cave_scene(kSceneX, kSceneY);
  for (auto _ : state) {
    const LayeredTerrain copy = scene;
    benchmark::DoNotOptimize(copy);
  }
}
BENCHMARK(columns_copy)->Unit(benchmark::kMicrosecond);

void columns_edit_tile(benchmark::State& state) {
  LayeredTerrain terrain = cave_scene(kSceneX, kSceneY);
  Steps top = 0;
  for (auto _ : state) {
    top = 1 - top;
    terrain.edit({64, 64, 128, 128}, [&](int, int, ColumnEditor& column) {
      column.replace(0, 1, top == 0 ? Material::bedrock : Material::sand);
    });
  }
}
BENCHMARK(columns_edit_tile)->Unit(benchmark::kMicrosecond);

// A step of sand on everything finds its way down.
void columns_sort(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  LayeredTerrain dusty = cave_scene(kSceneX, kSceneY);
  dusty.edit([](int, int, ColumnEditor& column) {
    const Steps top = column.layers().back().top();
    column.replace(top, top + 1, Material::sand);
  });
  for (auto _ : state) {
    LayeredTerrain terrain = dusty;
    benchmark::DoNotOptimize(sort_layers(terrain));
  }
}
BENCHMARK(columns_sort)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Boxes of a stone's size near the surface.
void layer_support_classify(benchmark::State& state) {
  const LayeredTerrain& scene = cave_scene(kSceneX, kSceneY);
  const LayerSupport support(scene, {Material::rocks});
  std::vector<Box3> boxes;
  for (int i = 0; i < 1 << 16; ++i) {
    const double x = uniform(hash(1, Purpose::texture, i, 0), 0, kSceneX);
    const double y = uniform(hash(1, Purpose::texture, i, 1), 0, kSceneY);
    const Layer& highest = scene.column(static_cast<int>(x), static_cast<int>(y)).back();
    const double depth = uniform(hash(1, Purpose::texture, i, 2), -1, 5);
    const Vec3 p(x, y, scene.height_of(highest.top()) - depth);
    boxes.push_back({p - 0.5, p + 0.5});
  }
  std::int64_t mixed = 0;
  for (std::size_t i = 0; auto _ : state)
    mixed += support.classify(boxes[i++ % boxes.size()]) == BoxState::mixed;
  state.counters["mixed_fraction"] =
      static_cast<double>(mixed) / static_cast<double>(state.iterations());
}
BENCHMARK(layer_support_classify)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace talus::bench
