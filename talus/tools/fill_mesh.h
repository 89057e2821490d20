// What a closed mesh encloses, filled column by column.
#pragma once

#include "talus/base/job.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

struct FillMeshParams {
  Material material = Material::bedrock;
  MaterialSet replaces = kAllMaterials;
  Vec2 origin{0};  // from where the mesh's positions count
};

// Fills every step of a column whose center the mesh winds around a positive number of times, as
// far as the material there may be replaced: exact, by where the columns' axes cross the triangles.
// The mesh must be closed and face outward; it may overlap itself, and be any size. Thin forms that
// no axis meets leave nothing. Throws `Error` (usage) for a vertex that is nowhere and a triangle
// of vertices that are not there.
Booking fill_mesh(LayeredTerrain& terrain, const TriangleMesh& mesh, const FillMeshParams& params,
                  Job* job = nullptr);

}  // namespace talus
