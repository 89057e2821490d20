#include "talus/tools/surface_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/terrain/terrain_field.h"

namespace talus {
namespace {

std::optional<SurfacePlace> descend(const TerrainField& field, const Vec3& point) {
  constexpr int kSteps = 20;
  constexpr double kClose = 1e-4;  // of the field
  Vec3 p = point;
  for (int i = 0; i < kSteps; ++i) {
    const double f = field.value(p);
    const Vec3 slope = field.gradient(p);
    const double steepness = glm::length(slope);
    if (std::abs(f) >= 1 || steepness * field.sigma() < 1e-3) break;
    if (std::abs(f) < kClose) return SurfacePlace{p, -slope / steepness, field.sigma()};
    p -= f / (steepness * steepness) * slope;
    if (glm::length(p - point) > field.sigma()) break;
  }
  return std::nullopt;
}

}  // namespace

double half_integer_columns(double length, const TerrainGrid& grid) {
  const double below = std::round(length / grid.cell - 0.5);
  return (std::clamp(below, 1.0, TerrainField::kSigmaColumnsMax - 1) + 0.5) * grid.cell;
}

std::optional<SurfacePlace> find_bedrock_surface(const LayeredTerrain& terrain, const Vec3& point,
                                                 double widest_sigma) {
  const TerrainGrid& grid = terrain.grid();
  double sigma = widest_sigma;
  auto place = descend(TerrainField(terrain, kBedrockOnly, sigma), point);
  while (!place && sigma > 1.5 * grid.cell) {
    sigma = half_integer_columns(0.5 * sigma, grid);
    place = descend(TerrainField(terrain, kBedrockOnly, sigma), point);
  }
  return place;
}

}  // namespace talus
