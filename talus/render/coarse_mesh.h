// Plainer stand-ins for meshes that are seen from afar.
#pragma once

#include "talus/mesh/triangle_mesh.h"

namespace talus {

// The mesh with all vertices in one cell of a cubic grid drawn together to their mean
// ([Rossignac1993]); `cells` cells span its longest side. Normals are averaged, shares dropped.
TriangleMesh coarse_mesh(const TriangleMesh& mesh, int cells);

}  // namespace talus
