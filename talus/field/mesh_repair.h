// Turning whatever mesh a user has into triangles with a meaningful inside.
#pragma once

#include <array>
#include <vector>

#include "talus/field/mesh_support.h"

namespace talus {

// Triangles over joined vertices, each oriented like its neighbors.
struct RepairedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool balanced = false;  // along every edge as many triangles run one way as the other, so that
                          // the winding number is an integer everywhere
  MeshSupportReport report;
};

// Joins equal positions, drops triangles without area and repeated ones, turns triangles that
// disagree with the majority of their connected patch, and turns the whole if it faces inward.
// Throws `Error` (input): no triangles, an index out of range, a coordinate that is not finite.
RepairedMesh repair(const TriangleMesh& mesh);

}  // namespace talus
