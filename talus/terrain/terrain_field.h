// The ground as a smooth solid.
#pragma once

#include <optional>

#include "talus/terrain/layered_terrain.h"

namespace talus {

// f(p) = 2 V / (8 sigma^3) - 1, where V is the volume of some materials in the cube of half-width
// sigma around p ([Peytavie2009a] §3.3): 1 where the cube holds nothing else, -1 where it holds
// none of them, 0 on the surface between. Exact, by the layers' overlap with the cube. Above the
// columns is air, below the floor bedrock; beyond the border the border columns go on outward.
//
// With 2 sigma a whole number of columns, a plane's staircase averages to the plane as long as no
// column under the cube begins or ends within it: for slopes (dz/dx, dz/dy) with
// |dz/dx| + |dz/dy| <= sigma / (sigma + cell / 2), 2/3 for the default of one column spacing.
// docs/terrain.md tells what is left of the steps beyond.
//
// Keeps a reference to the terrain. Safe for concurrent use. For many places near each other a
// `FieldSampler` is faster.
class TerrainField {
 public:
  // `sigma` in metres, the column spacing by default. Throws `Error` (usage) unless it is positive
  // and at most `kSigmaColumnsMax` columns.
  explicit TerrainField(const LayeredTerrain& terrain, MaterialSet materials = kGroundMaterials,
                        std::optional<double> sigma = {});
  static constexpr double kSigmaColumnsMax = 64;

  const LayeredTerrain& terrain() const { return *terrain_; }
  MaterialSet materials() const { return materials_; }
  double sigma() const { return sigma_; }

  // At a finite point in metres.
  double value(const Vec3& p) const;
  // Per metre, along the axes of the world: differences of the areas that the materials take of the
  // cube's opposite faces. Where a face lies between two columns, the mean of both sides.
  Vec3 gradient(const Vec3& p) const;

  // A point in grid units: columns from the south-west corner along x and y, steps along z. Between
  // two columns a coordinate is whole, whatever the spacing.
  Vec3 grid_from_world(const Vec3& p) const;

 private:
  const LayeredTerrain* terrain_;
  MaterialSet materials_;
  double sigma_;
};

}  // namespace talus
