#include "talus/tools/sculpt.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "talus/base/error.h"
#include "talus/terrain/terrain_field.h"
#include "talus/tools/surface_place.h"
#include "talus/tools/surface_profiles.h"

namespace talus {
namespace {

// What a dab adds to the field, or takes from it.
class DabField {
 public:
  // For a field that falls by 1 over `sigma` along a flat surface's normal; the center lies `depth`
  // below the surface, above it when carving.
  DabField(const DabParams& params, double sigma, const SurfacePlace& place, double depth)
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

// Half the radius; in a wall no thicker, when adding, half as far as it is thick, so that the guard
// holds its far side.
double depth_of_center(const TerrainField& field, const SurfacePlace& place,
                       const DabParams& params) {
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
  check_inside(grid, Vec2(point), "sculpt");
  const double widest = half_integer_columns(0.5 * params.radius, grid);
  const auto place = find_bedrock_surface(terrain, point, widest);
  if (!place)
    throw usage_error(fmt::format(
        "sculpt.points: no bedrock's surface within {:.3g} m of ({:.6g}, {:.6g}, {:.6g})", widest,
        point.x, point.y, point.z));
  const double sigma = place->sigma;
  const TerrainField field(terrain, kBedrockOnly, sigma);
  const DabField added(params, sigma, *place, depth_of_center(field, *place, params));
  if (params.height == 0) return {};
  const SurfaceProfiles profiles(terrain, kBedrockOnly, sigma, added.center(), added.radius());
  return terrain.edit(
      profiles.area(),
      [&](int x, int y, ColumnEditor& column) {
        const Vec2 axis = grid.center(x, y);
        const SurfaceMove move = profiles.move(x, y, [&](double z) { return added.at({axis, z}); });
        move_boundaries(column, move, grid.step, params.carve);
      },
      job);
}

Booking sculpt(LayeredTerrain& terrain, const std::vector<SurfacePoint>& points,
               const StrokeParams& params, Job* job) {
  validate(params, "sculpt");
  if (points.empty()) throw usage_error("sculpt.points is empty; a stroke needs at least one");
  LayeredTerrain changed = terrain;
  Booking booking;
  for (const auto& [at, z] : places_along(points, params.spacing * params.dab.radius, "sculpt")) {
    check_cancelled(job);
    booking.add(dab(changed, {at, z ? *z : top_of_bedrock(changed, at)}, params.dab, job));
  }
  terrain = std::move(changed);
  return booking;
}

}  // namespace talus
