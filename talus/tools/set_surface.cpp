#include "talus/tools/set_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace talus {
namespace {

constexpr double kFloorDepthShare = 0.1;

// Everything below `top` that is air, caves too, becomes the material; everything above goes.
void set_column(ColumnEditor& column, Steps floor, Steps top, Material material) {
  Steps bottom = floor;
  std::vector<std::pair<Steps, Steps>> gaps;
  for (const Layer& layer : column.layers()) {
    if (layer.material() == Material::air) gaps.emplace_back(bottom, std::min(layer.top(), top));
    bottom = layer.top();
  }
  gaps.emplace_back(bottom, top);
  for (const auto& [from, to] : gaps)
    if (from < to) column.replace(from, to, material);
  if (top < bottom) column.replace(top, bottom, Material::air);
}

}  // namespace

Steps floor_below(double lowest, const TerrainGrid& grid) {
  const double depth = kFloorDepthShare * grid.cell * std::max(grid.nx, grid.ny);
  const double floor = std::floor((lowest - depth) / grid.step);
  if (!(std::abs(floor) <= kStepsMax))
    throw usage_error(
        fmt::format("heights near {} m cannot be counted in steps of {} m; give a "
                    "step of at least {:.2g} m",
                    lowest, grid.step, 1.05 * std::abs(lowest - depth) / kStepsMax));
  return static_cast<Steps>(floor);
}

Booking set_surface(LayeredTerrain& terrain, const HeightGrid& heights,
                    const SetSurfaceParams& params, Job* job) {
  const TerrainGrid& grid = terrain.grid();
  if (heights.cell != grid.cell)
    throw usage_error(
        fmt::format("the heights' cells are {} m wide, the terrain's {} m; resample "
                    "them to the terrain's",
                    heights.cell, grid.cell));
  return terrain.edit(
      {params.x_begin, params.y_begin, params.x_begin + heights.nx, params.y_begin + heights.ny},
      [&](int x, int y, ColumnEditor& column) {
        const float height = heights.heights[heights.index(x - params.x_begin, y - params.y_begin)];
        if (!std::isfinite(height)) return;
        const Steps target = std::max(terrain.nearest_step(height), grid.floor);
        const auto layers = column.layers();
        const Steps top = layers.empty() ? grid.floor : layers.back().top();
        switch (params.change) {
          case SurfaceChange::set:
            set_column(column, grid.floor, target, params.material);
            break;
          case SurfaceChange::raise:
            if (top < target) column.replace(top, target, params.material);
            break;
          case SurfaceChange::lower:
            if (target < top) column.replace(target, top, Material::air);
            break;
        }
      },
      job);
}

LayeredTerrain make_terrain(const HeightGrid& heights, double step, Job* job) {
  const std::optional<double> lowest = lowest_height(heights);
  if (!lowest) throw usage_error("no height is known; give at least one");
  TerrainGrid grid{.nx = heights.nx, .ny = heights.ny, .cell = heights.cell, .step = step};
  grid.floor = floor_below(*lowest, grid);
  LayeredTerrain terrain(grid);
  set_surface(terrain, heights, {}, job);
  return terrain;
}

}  // namespace talus
