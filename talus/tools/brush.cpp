#include "talus/tools/brush.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "talus/base/error.h"

namespace talus {
namespace {

constexpr int kTile = LayeredTerrain::kTileColumns;
constexpr double kWorkMax = 4e9;  // columns that dabs reach, counted for each dab

int tiles_along(int columns) { return (columns + kTile - 1) / kTile; }

void check_mask(const ColumnMask& mask, const TerrainGrid& grid, std::string_view tool) {
  if (mask.nx != grid.nx || mask.ny != grid.ny)
    throw usage_error(fmt::format(
        "{}.mask has {} x {} pixels; it must have one for each column of the terrain, {} x {}",
        tool, mask.nx, mask.ny, grid.nx, grid.ny));
  const bool in_range = std::all_of(mask.shares.begin(), mask.shares.end(),
                                    [](float share) { return share >= 0 && share <= 1; });
  if (!in_range ||
      mask.shares.size() != static_cast<std::size_t>(mask.nx) * static_cast<std::size_t>(mask.ny))
    throw usage_error(fmt::format("{}.mask must have a share from 0 to 1 for each pixel", tool));
}

}  // namespace

Brush::Brush(const TerrainGrid& grid, const BrushRegion& region, const BrushParams& params,
             std::string_view tool)
    : grid_(grid), mask_(region.mask ? &*region.mask : nullptr), radius_(params.radius) {
  if (region.points.empty() && !mask_)
    throw usage_error(
        fmt::format("{}.points is empty, and there is no mask; give one of them", tool));
  if (mask_) check_mask(*mask_, grid, tool);
  const std::vector<SurfacePoint> dabs =
      places_along(region.points, params.spacing * params.radius, tool);
  for (const SurfacePoint& point : region.points) check_inside(grid, point.at, tool);
  if (dabs.empty()) {
    area_ = {0, 0, grid.nx, grid.ny};
    return;
  }

  const double across = std::min(2 * radius_ / grid.cell, std::hypot(grid.nx, grid.ny));
  if (static_cast<double>(dabs.size()) * across * across > kWorkMax)
    throw usage_error(fmt::format(
        "{}: {} dabs of {:.3g} columns across are too much work; choose a larger spacing", tool,
        dabs.size(), across));
  area_ = {grid.nx, grid.ny, 0, 0};
  by_tile_.resize(tile_of(grid.nx - 1, grid.ny - 1) + 1);
  for (const SurfacePoint& dab : dabs) {
    const ColumnArea reached = grid.columns_within(dab.at - radius_, dab.at + radius_);
    area_ = {std::min(area_.x_begin, reached.x_begin), std::min(area_.y_begin, reached.y_begin),
             std::max(area_.x_end, reached.x_end), std::max(area_.y_end, reached.y_end)};
    for (int y = reached.y_begin / kTile; y <= (reached.y_end - 1) / kTile; ++y)
      for (int x = reached.x_begin / kTile; x <= (reached.x_end - 1) / kTile; ++x)
        by_tile_[tile_of(kTile * x, kTile * y)].push_back(dab);
  }
}

void Brush::lay_on_bedrock(const LayeredTerrain& terrain) {
  for (std::vector<SurfacePoint>& dabs : by_tile_)
    for (SurfacePoint& dab : dabs)
      if (!dab.z) dab.z = top_of_bedrock(terrain, dab.at);
}

std::size_t Brush::tile_of(int x, int y) const {
  return static_cast<std::size_t>(y / kTile) * static_cast<std::size_t>(tiles_along(grid_.nx)) +
         static_cast<std::size_t>(x / kTile);
}

std::span<const SurfacePoint> Brush::dabs_near(int x, int y) const {
  return by_tile_[tile_of(x, y)];
}

double Brush::mask(int x, int y) const {
  if (!mask_) return 1;
  return mask_->shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.nx) +
                       static_cast<std::size_t>(x)];
}

}  // namespace talus
