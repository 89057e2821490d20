// Small meshes with known answers.
#pragma once

#include "talus/mesh/triangle_mesh.h"

namespace talus::test {

// Cube [0, 1]^3, closed, outward, 8 vertices, 12 triangles.
inline TriangleMesh unit_cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                static_cast<float>(i >> 2 & 1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace talus::test
