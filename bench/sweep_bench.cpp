// Promise: a rough gorge swept across a million columns takes less than a second.
#include "bench/measure.h"
#include "talus/tools/sweep.h"

namespace talus::bench {
namespace {

LayeredTerrain plateau(int columns) {
  const TerrainGrid grid{.nx = columns, .ny = columns, .cell = 0.5, .floor = -60000};
  LayeredTerrain terrain(grid);
  terrain.edit(
      [](int, int, ColumnEditor& column) { column.replace(column.floor(), 0, Material::bedrock); });
  return terrain;
}

// With undercut walls, a tenth of the terrain wide, and a branch.
void gorge(benchmark::State& state, int columns, bool projected) {
  const LayeredTerrain before = plateau(columns);
  const double side = columns * before.grid().cell, unit = 0.01 * side;
  SweepParams params{.profile = {{-4, 3}, {-5, -1}, {-4, -4}, {4, -4}, {5, -1}, {4, 3}},
                     .arcs = {{0, 1}, {1, 2}, {2, 3}, {2, 4}},
                     .projected = projected,
                     .fill = {.roughness = unit * 0.3, .roughness_size = unit * 2}};
  for (Vec2& point : params.profile) point *= unit;
  for (const Vec2 at : {Vec2(0, 0.2), Vec2(0.3, 0.3), Vec2(0.6, 0.5), Vec2(1, 0.8), Vec2(0.9, 0.1)})
    params.nodes.push_back({.at = {side * at, {}}});
  const Bound bound(state, 1);
  for (auto _ : state) {
    LayeredTerrain terrain = before;
    sweep(terrain, params, 1);
    benchmark::DoNotOptimize(terrain);
  }
}
BENCHMARK_CAPTURE(gorge, million_columns, 1000, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(gorge, projected, 1000, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(gorge, small, 100, true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus::bench
