#include "talus/terrain/terrain_field.h"

#include <fmt/format.h>

#include "talus/terrain/field_sampler.h"

namespace talus {

TerrainField::TerrainField(const LayeredTerrain& terrain, MaterialSet materials,
                           std::optional<double> sigma)
    : terrain_(&terrain), materials_(materials), sigma_(sigma.value_or(terrain.grid().cell)) {
  const double largest = kSigmaColumnsMax * terrain.grid().cell;
  if (!(sigma_ > 0 && sigma_ <= largest))
    throw usage_error(fmt::format(
        "sigma = {} m is out of range; it must be positive and at most {} m, {} columns", sigma_,
        largest, kSigmaColumnsMax));
}

double TerrainField::value(const Vec3& p) const {
  return FieldSampler(*this).value(grid_from_world(p));
}

Vec3 TerrainField::gradient(const Vec3& p) const {
  return FieldSampler(*this).gradient(grid_from_world(p));
}

Vec3 TerrainField::grid_from_world(const Vec3& p) const {
  const TerrainGrid& grid = terrain_->grid();
  return {(p.x - grid.origin_x) / grid.cell, (p.y - grid.origin_y) / grid.cell, p.z / grid.step};
}

}  // namespace talus
