#include "talus/tools/sculpt.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "talus/base/error.h"
#include "talus/terrain/terrain_field.h"
#include "talus/tools/surface_profiles.h"

namespace talus {
namespace {

constexpr MaterialSet kBedrock{Material::bedrock};

// On the surface of the bedrock.
struct Place {
  Vec3 point;
  Vec3 normal;  // out of it
};

// What a dab adds to the field, or takes from it.
class DabField {
 public:
  // For a field that falls by 1 over `sigma` along a flat surface's normal; the center lies `depth`
  // below the surface, above it when carving.
  DabField(const DabParams& params, double sigma, const Place& place, double depth)
      : radius_(params.radius), sign_(params.carve ? -1 : 1), outward_(sign_ * place.normal) {
    center_ = place.point - depth * outward_;
    strength_ = params.height / sigma / falloff(depth + params.height);
  }

  const Vec3& center() const { return center_; }
  double radius() const { return radius_; }

  // Nothing on the far side of the center, where another surface of a thin wall may be.
  double at(const Vec3& p) const {
    const Vec3 from_center = p - center_;
    if (glm::dot(outward_, from_center) <= 0) return 0;
    return sign_ * strength_ * falloff(glm::length(from_center));
  }

 private:
  double falloff(double distance) const {
    const double share = distance / radius_, rest = 1 - share * share;
    return share < 1 ? rest * rest : 0;
  }

  double radius_;
  double sign_;
  Vec3 outward_;  // to where the surface moves
  Vec3 center_;
  double strength_;
};

// The half-integer number of columns, at least 1.5, that is nearest to a length.
double half_integer(double length, double cell) {
  return (std::max(1.0, std::round(length / cell - 0.5)) + 0.5) * cell;
}

void validate_dab(const DabParams& params, double cell) {
  validate(params, "sculpt");
  const double columns = params.radius / cell;
  if (columns < kDabColumnsMin || columns > kDabColumnsMax)
    throw usage_error(
        fmt::format("sculpt.radius = {} m is {:.3g} columns of {} m; it must be {} to {} columns",
                    params.radius, columns, cell, kDabColumnsMin, kDabColumnsMax));
  if (params.height > 0.25 * params.radius)
    throw usage_error(fmt::format(
        "sculpt.height = {} m is more than a quarter of sculpt.radius = {} m; use more dabs",
        params.height, params.radius));
}

// Where the topmost bedrock of a place ends, in metres.
double top_of_bedrock(const LayeredTerrain& terrain, const Vec2& at) {
  const TerrainGrid& grid = terrain.grid();
  const int x = std::clamp(grid.column_x(at.x), 0, grid.nx - 1);
  const int y = std::clamp(grid.column_y(at.y), 0, grid.ny - 1);
  Steps top = grid.floor;
  for (const Layer& layer : terrain.column(x, y))
    if (layer.material() == Material::bedrock) top = layer.top();
  return terrain.height_of(top);
}

// The place on the field's surface to which its gradient leads, at most sigma away.
std::optional<Place> project(const TerrainField& field, const Vec3& point) {
  constexpr int kSteps = 20;
  constexpr double kClose = 1e-4;  // of the field
  Vec3 p = point;
  for (int i = 0; i < kSteps; ++i) {
    const double f = field.value(p);
    const Vec3 slope = field.gradient(p);
    const double steepness = glm::length(slope);
    if (std::abs(f) >= 1 || steepness * field.sigma() < 1e-3) break;
    if (std::abs(f) < kClose) return Place{p, -slope / steepness};
    p -= f / (steepness * steepness) * slope;
    if (glm::length(p - point) > field.sigma()) break;
  }
  return std::nullopt;
}

// Half the radius; in a wall no thicker, when adding, half as far as it is thick, so that the guard
// holds its far side.
double depth_of_center(const TerrainField& field, const Place& place, const DabParams& params) {
  const double depth = 0.5 * params.radius;
  if (params.carve) return depth;
  const double stride = 0.25 * field.sigma();
  for (double thickness = stride; thickness < 2 * depth; thickness += stride)
    if (field.value(place.point - thickness * place.normal) <= 0) return 0.5 * thickness;
  return depth;
}

}  // namespace

Booking dab(LayeredTerrain& terrain, const Vec3& point, const DabParams& params, Job* job) {
  const TerrainGrid& grid = terrain.grid();
  validate_dab(params, grid.cell);
  if (grid.column_x(point.x) < 0 || grid.column_x(point.x) >= grid.nx ||
      grid.column_y(point.y) < 0 || grid.column_y(point.y) >= grid.ny)
    throw usage_error(fmt::format(
        "sculpt.points: ({:.6g}, {:.6g}) is outside the terrain, which reaches from ({:.6g}, "
        "{:.6g}) to ({:.6g}, {:.6g})",
        point.x, point.y, grid.origin_x, grid.origin_y, grid.origin_x + grid.nx * grid.cell,
        grid.origin_y + grid.ny * grid.cell));
  const double widest = half_integer(0.5 * params.radius, grid.cell);
  double sigma = widest;
  std::optional<Place> place = project(TerrainField(terrain, kBedrock, sigma), point);
  while (!place && sigma > 1.5 * grid.cell) {
    sigma = half_integer(0.5 * sigma, grid.cell);
    place = project(TerrainField(terrain, kBedrock, sigma), point);
  }
  if (!place)
    throw usage_error(fmt::format(
        "sculpt.points: no bedrock's surface within {:.3g} m of ({:.6g}, {:.6g}, {:.6g})", widest,
        point.x, point.y, point.z));
  const TerrainField field(terrain, kBedrock, sigma);
  const DabField added(params, sigma, *place, depth_of_center(field, *place, params));
  if (params.height == 0) return {};
  const SurfaceProfiles profiles(terrain, kBedrock, sigma, added.center(), added.radius());
  return terrain.edit(
      profiles.area(),
      [&](int x, int y, ColumnEditor& column) {
        const Vec2 axis(grid.origin_x + (x + 0.5) * grid.cell,
                        grid.origin_y + (y + 0.5) * grid.cell);
        const SurfaceMove move = profiles.move(x, y, [&](double z) { return added.at({axis, z}); });
        move_boundaries(column, move, grid.step, params.carve);
      },
      job);
}

Booking sculpt(LayeredTerrain& terrain, const std::vector<SurfacePoint>& points,
               const StrokeParams& params, Job* job) {
  validate(params, "sculpt");
  if (points.empty()) throw usage_error("sculpt.points is empty; a stroke needs at least one");
  for (const SurfacePoint& point : points)
    if (!std::isfinite(point.at.x + point.at.y + point.z.value_or(0)))
      throw usage_error("sculpt.points: a coordinate is no finite number");
  LayeredTerrain changed = terrain;
  Booking booking;
  const auto touch = [&](const Vec2& at, std::optional<double> z) {
    check_cancelled(job);
    if (!z) z = top_of_bedrock(changed, at);
    booking.add(dab(changed, {at, *z}, params.dab, job));
  };
  touch(points.front().at, points.front().z);
  // How far the next dab is from the point reached.
  double rest = params.spacing * params.dab.radius;
  const double step = rest;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const SurfacePoint &a = points[i - 1], &b = points[i];
    const bool in_space = a.z && b.z;
    const double length =
        in_space ? glm::length(Vec3(b.at, *b.z) - Vec3(a.at, *a.z)) : glm::length(b.at - a.at);
    double walked = 0;
    for (; walked + rest <= length; rest = step) {
      walked += rest;
      const double share = walked / length;
      touch(glm::mix(a.at, b.at, share),
            in_space ? std::optional(std::lerp(*a.z, *b.z, share)) : std::nullopt);
    }
    rest -= length - walked;
  }
  terrain = std::move(changed);
  return booking;
}

}  // namespace talus
