// The surface of open water.
#pragma once

#include <optional>

#include "talus/base/describe.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

struct WaterSurfaceParams {
  std::optional<double> bank;

  static void describe(auto& p, auto&& field) {
    field(p.bank, Field{.name = "bank",
                        .help = "how far water goes on under its banks, which the ground's mesh "
                                "draws back by up to its sigma; the column spacing by default",
                        .unit = "m",
                        .min = 0,
                        .max = 1e6});
  }
};

// A level square on top of every layer of water under the open sky or the air of a cave, facing
// upward; squares of one level share their corners. Water goes on under its bank, by whole columns,
// so that no gap shows between it and the smoothed ground; it reaches neither into air nor into
// other water. Positions are relative to `origin`. Throws `Error` (usage) for a bank out of range
// or of more than `TerrainField::kSigmaColumnsMax` columns.
TriangleMesh make_water_surface(const LayeredTerrain& terrain, const Vec3& origin,
                                const WaterSurfaceParams& params, Job* job = nullptr);
// With the default params.
TriangleMesh make_water_surface(const LayeredTerrain& terrain, const Vec3& origin,
                                Job* job = nullptr);

}  // namespace talus
