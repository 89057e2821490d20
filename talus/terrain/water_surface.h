// The surface of open water.
#pragma once

#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

// A level square on top of every layer of water under the open sky or the air of a cave, facing
// upward; squares of one level share their corners. Water goes on for one column under its bank,
// which is as far as the ground's field can draw that back, so that no gap shows between them; it
// does not reach into air. Positions are relative to `origin`.
TriangleMesh make_water_surface(const LayeredTerrain& terrain, const Vec3& origin,
                                Job* job = nullptr);

}  // namespace talus
