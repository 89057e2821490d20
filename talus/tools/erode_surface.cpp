#include "talus/tools/erode_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace talus {
namespace {

// How strongly a dab works at a distance, by the squares of that and of the radius.
double falloff(double distance_squared, double radius_squared) {
  const double rest = std::max(0.0, 1 - distance_squared / radius_squared);
  return rest * rest;
}

// On a surface of a column; all dabs have a z.
double strength_at(const Brush& brush, int x, int y, double z) {
  if (brush.everywhere()) return brush.mask(x, y);
  const Vec3 p(brush.axis(x, y), z);
  double nearest = HUGE_VAL;
  for (const SurfacePoint& dab : brush.dabs_near(x, y)) {
    const Vec3 offset = p - Vec3(dab.at, *dab.z);
    nearest = std::min(nearest, glm::dot(offset, offset));
  }
  return brush.mask(x, y) * falloff(nearest, brush.radius() * brush.radius());
}

}  // namespace

Booking erode_surface(LayeredTerrain& terrain, const BrushRegion& region,
                      const ErodeSurfaceParams& params, Job* job) {
  validate(params, "erode_surface");
  Brush brush(terrain.grid(), region, params.brush, "erode_surface");
  brush.lay_on_bedrock(terrain);
  const double depth = params.amount * params.depth;
  return terrain.edit(
      brush.area(),
      [&](int x, int y, ColumnEditor& column) {
        Steps bottom = column.floor();
        const std::span<const Layer> layers = terrain.column(x, y);
        for (std::size_t i = 0; i < layers.size(); ++i) {
          const Layer& layer = layers[i];
          const bool open = i + 1 == layers.size() || layers[i + 1].material() == Material::air;
          if (layer.material() == Material::bedrock && open) {
            const double strength = strength_at(brush, x, y, terrain.height_of(layer.top()));
            const Steps lost = terrain.nearest_step(depth * strength, layer.top() - bottom);
            column.replace(layer.top() - lost, layer.top(), Material::sand);
          }
          bottom = layer.top();
        }
      },
      job);
}

}  // namespace talus
