#include "talus/tools/stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "talus/base/error.h"

namespace talus {
namespace {

bool in_space(const SurfacePoint& a, const SurfacePoint& b) { return a.z && b.z; }

double distance(const SurfacePoint& a, const SurfacePoint& b) {
  return in_space(a, b) ? glm::length(Vec3(b.at, *b.z) - Vec3(a.at, *a.z))
                        : glm::length(b.at - a.at);
}

}  // namespace

std::vector<SurfacePoint> places_along(const std::vector<SurfacePoint>& points, double step,
                                       std::string_view tool) {
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].at.x + points[i].at.y + points[i].z.value_or(0)))
      throw usage_error(fmt::format("{}.points: a coordinate is no finite number", tool));
    if (i > 0) length += distance(points[i - 1], points[i]);
  }
  if (length / step >= kDabsMax)
    throw usage_error(
        fmt::format("{}.points: a stroke of {:.4g} m with a dab every {:.4g} m is more than {} "
                    "dabs; choose a larger spacing or radius",
                    tool, length, step, kDabsMax));

  std::vector<SurfacePoint> places;
  if (!points.empty()) places.push_back(points.front());
  // How far the next dab is from the point reached.
  double rest = step;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const SurfacePoint &a = points[i - 1], &b = points[i];
    const double segment = distance(a, b);
    double walked = 0;
    for (; walked + rest <= segment; rest = step) {
      walked += rest;
      const double share = walked / segment;
      SurfacePoint& place = places.emplace_back();
      place.at = glm::mix(a.at, b.at, share);
      if (in_space(a, b)) place.z = std::lerp(*a.z, *b.z, share);
    }
    rest -= segment - walked;
  }
  return places;
}

void check_inside(const TerrainGrid& grid, const Vec2& at, std::string_view tool) {
  const int x = grid.column_x(at.x), y = grid.column_y(at.y);
  if (x >= 0 && x < grid.nx && y >= 0 && y < grid.ny) return;
  throw usage_error(fmt::format(
      "{}.points: ({:.6g}, {:.6g}) is outside the terrain, which reaches from ({:.6g}, {:.6g}) to "
      "({:.6g}, {:.6g})",
      tool, at.x, at.y, grid.origin_x, grid.origin_y, grid.origin_x + grid.nx * grid.cell,
      grid.origin_y + grid.ny * grid.cell));
}

double top_of_bedrock(const LayeredTerrain& terrain, const Vec2& at) {
  const TerrainGrid& grid = terrain.grid();
  const int x = std::clamp(grid.column_x(at.x), 0, grid.nx - 1);
  const int y = std::clamp(grid.column_y(at.y), 0, grid.ny - 1);
  Steps top = grid.floor;
  for (const Layer& layer : terrain.column(x, y))
    if (layer.material() == Material::bedrock) top = layer.top();
  return terrain.height_of(top);
}

}  // namespace talus
