// An indexed triangle mesh.
#pragma once

#include <vector>

#include "talus/base/vec.h"

namespace talus {

// Counter-clockwise triangles seen from outside. `normals` is empty or has one unit vector per
// position.
struct TriangleMesh {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Triangle> triangles;
};

Box3 bounds(const TriangleMesh& mesh);

// Signed volume by the divergence theorem: positive for a closed mesh that faces outward. Summed
// about the box centre, so that a mesh far from the origin keeps its digits.
double signed_volume(const TriangleMesh& mesh);

// Sets one normal per vertex: the sum over its triangles of e1 x e2 / (|e1|^2 |e2|^2) for the edges
// e1, e2 that leave it ([Max1999]), exact for vertices on a sphere. A vertex without area gets
// (0, 0, 1).
void compute_normals(TriangleMesh& mesh);

}  // namespace talus
