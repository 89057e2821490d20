// Promise: a stroke of 100 dabs of radius 20 columns across the landscape of a million columns and
// its caves drops sand, or turns bedrock into it, in less than a tenth of a second; an exact volume
// over all of it in less than a second.
#include <cmath>
#include <vector>

#include "bench/measure.h"
#include "bench/terrain_scene.h"
#include "talus/tools/deposit.h"
#include "talus/tools/erode_surface.h"

namespace talus::bench {
namespace {

// From corner to corner, a dab every radius at 1 000 columns.
BrushRegion diagonal(const TerrainGrid& grid) {
  const Vec2 size = grid.cell * Vec2(grid.nx, grid.ny);
  return {.points = {{0.02 * size, {}}, {0.98 * size, {}}}};
}

BrushParams brush(const TerrainGrid& grid) {
  const double length = 0.96 * grid.cell * std::hypot(grid.nx, grid.ny), radius = 20 * grid.cell;
  return {.radius = radius, .spacing = length / 99 / radius};
}

// Edits a copy of the landscape, promised within some seconds.
void edit(benchmark::State& state, const LayeredTerrain& before, double seconds, auto&& tool) {
  const Bound bound(state, seconds);
  for (auto _ : state) {
    LayeredTerrain terrain = before;
    tool(terrain);
    benchmark::DoNotOptimize(terrain);
  }
}

void drop(benchmark::State& state, int columns) {
  const LayeredTerrain& before = cave_scene(columns, columns);
  const DepositParams params{.height = 0.5, .brush = brush(before.grid())};
  const BrushRegion region = diagonal(before.grid());
  edit(state, before, 0.1, [&](LayeredTerrain& terrain) { deposit(terrain, region, params, 1); });
}

void drop_volume(benchmark::State& state, int columns) {
  const LayeredTerrain& before = cave_scene(columns, columns);
  const TerrainGrid& grid = before.grid();
  const double area = grid.cell * grid.cell * grid.nx * grid.ny;
  const DepositParams params{.volume = 0.1 * area, .profile = DepositProfile::noise};
  const std::vector<float> everywhere(static_cast<std::size_t>(grid.nx * grid.ny), 1.0f);
  const BrushRegion region{.mask = ColumnMask{.nx = grid.nx, .ny = grid.ny, .shares = everywhere}};
  edit(state, before, 1, [&](LayeredTerrain& terrain) { deposit(terrain, region, params, 1); });
}

void erode(benchmark::State& state, int columns) {
  const LayeredTerrain& before = cave_scene(columns, columns);
  const ErodeSurfaceParams params{.brush = brush(before.grid())};
  const BrushRegion region = diagonal(before.grid());
  edit(state, before, 0.1,
       [&](LayeredTerrain& terrain) { erode_surface(terrain, region, params); });
}

BENCHMARK_CAPTURE(drop, million_columns, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, small, 100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop_volume, million_columns, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop_volume, small, 100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(erode, million_columns, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(erode, small, 100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus::bench
