// Promise: a dab of radius 20 columns on a million columns, with deposits put in order and the mesh
// around it made anew, takes less than 16 ms; a stroke of 100 dabs less than 0.8 s.
#include <cmath>

#include "bench/measure.h"
#include "talus/settle/layer_order.h"
#include "talus/terrain/ground_mesh.h"
#include "talus/tools/sculpt.h"

namespace talus::bench {
namespace {

LayeredTerrain hills(int columns) {
  const TerrainGrid grid{.nx = columns, .ny = columns, .cell = 0.5, .floor = -30000};
  LayeredTerrain terrain(grid);
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const double height = 3 * std::sin(0.02 * x) * std::cos(0.03 * y);
    column.replace(grid.floor, static_cast<Steps>(height / grid.step), Material::bedrock);
    column.replace(column.layers().back().top(), column.layers().back().top() + 100,
                   Material::sand);
  });
  return terrain;
}

// Around what a dab at a place reaches: its columns, and what the mesh takes in beside them.
ColumnArea around(const TerrainGrid& grid, const Vec2& at, double radius) {
  const int reach = static_cast<int>(2 * radius / grid.cell) + 2;
  const int x = grid.column_x(at.x), y = grid.column_y(at.y);
  return intersection({x - reach, y - reach, x + reach, y + reach}, {0, 0, grid.nx, grid.ny});
}

void dab_with_mesh(benchmark::State& state, int columns) {
  const LayeredTerrain before = hills(columns);
  const double radius = 20 * before.grid().cell, middle = 0.5 * columns * before.grid().cell;
  const ColumnArea area = around(before.grid(), Vec2(middle), radius);
  const Bound bound(state, 0.016);
  for (auto _ : state) {
    LayeredTerrain terrain = before;
    sculpt(terrain, {{Vec2(middle), {}}}, {.dab = {.radius = radius, .height = 1}});
    sort_layers(terrain, area);
    const GroundMesh mesh = make_ground_mesh(terrain, {.skirt = 0.0, .base = false, .area = area});
    benchmark::DoNotOptimize(mesh.mesh.positions.data());
  }
}
BENCHMARK_CAPTURE(dab_with_mesh, million_columns, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(dab_with_mesh, small, 100)->Unit(benchmark::kMillisecond);

void stroke(benchmark::State& state) {
  const LayeredTerrain before = hills(1000);
  const double radius = 20 * before.grid().cell;
  const Bound bound(state, 0.8);
  for (auto _ : state) {
    LayeredTerrain terrain = before;
    // 99 spacings of a quarter of the radius.
    sculpt(terrain, {{{100, 250}, {}}, {{100 + 24.8 * radius, 250}, {}}},
           {.dab = {.radius = radius, .height = 0.3}, .spacing = 0.25});
    benchmark::DoNotOptimize(terrain);
  }
}
BENCHMARK(stroke)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus::bench
