// Turning whatever mesh a user has into triangles with a meaningful inside.
#pragma once

#include <vector>

#include "talus/field/mesh_support.h"
#include "talus/field/triangle_grid.h"

namespace talus {

// Triangles over joined vertices, each oriented like its neighbors.
struct RepairedMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  // Fans over the holes, one for each connected rim around the middle of its vertices: with them
  // as many triangles run along every edge one way as the other, so that the winding number is an
  // integer everywhere. Empty if that is so without them.
  std::vector<Triangle> caps;
  MeshSupportReport report;
};

// Joins equal positions, drops triangles without area and repeated ones, turns triangles that
// disagree with the majority of their connected patch, and turns the whole if it faces inward.
// Throws `Error` (input): no triangles, an index out of range, a coordinate that is not finite.
RepairedMesh repair(const TriangleMesh& mesh);

}  // namespace talus
