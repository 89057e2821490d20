// Normals for meshes that come without.
#pragma once

#include "talus/mesh/triangle_mesh.h"

namespace talus {

// The mesh with normals that are smooth within its faces and break at its creases: edges that do
// not lie between two triangles facing alike to within `angle_deg`. A vertex on a crease comes out
// once for each face; triangles keep their order and corners their positions and shares. Large
// triangles count more, so that slivers do not show.
TriangleMesh with_creased_normals(const TriangleMesh& mesh, double angle_deg);

}  // namespace talus
