// An indexed triangle mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// How much of each of up to eight materials shows at a place, in 255ths that sum to 255.
using MaterialShares = std::array<std::uint8_t, 8>;

// Counter-clockwise triangles seen from outside. `normals` is empty or has one unit vector per
// position, `shares` is empty or has one entry per position.
struct TriangleMesh {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Triangle> triangles;
  std::vector<MaterialShares> shares;
};

Box3 bounds(const TriangleMesh& mesh);

// Signed volume by the divergence theorem: positive for a closed mesh that faces outward. Summed
// about a vertex, so that a mesh far from the origin keeps its digits.
double signed_volume(const TriangleMesh& mesh);

// Sets one normal per vertex: the sum over its triangles of e1 x e2 / (|e1|^2 |e2|^2) for the edges
// e1, e2 that leave it ([Max1999]), exact for vertices on a sphere. A vertex without area gets
// (0, 0, 1).
void compute_normals(TriangleMesh& mesh);

}  // namespace talus
