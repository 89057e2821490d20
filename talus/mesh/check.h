// Whether a mesh bounds a solid.
#pragma once

#include <cstdint>

#include "talus/mesh/triangle_mesh.h"

namespace talus {

struct MeshCheck {
  std::uint64_t vertices = 0;  // distinct positions
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;             // two corners at one position
  std::uint64_t boundary_edges = 0;         // one triangle
  std::uint64_t non_manifold_edges = 0;     // more than two triangles
  std::uint64_t misoriented_edges = 0;      // two triangles that run along it the same way
  std::uint64_t non_manifold_vertices = 0;  // whose triangles form more than one fan

  // Edges along which more triangles run one way than the other; without any the mesh bounds
  // solids, which may touch along edges that are then not manifold.
  std::uint64_t unbalanced_edges = 0;

  bool bounds_solids() const { return triangles > 0 && unbalanced_edges == 0; }
  bool closed() const { return triangles > 0 && boundary_edges == 0; }
  bool manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }
  bool oriented() const { return misoriented_edges == 0 && non_manifold_edges == 0; }
};

// Counts edges after joining vertices at bit-equal positions, so that a mesh split at texture
// seams is judged as the surface it draws. Degenerate triangles are counted and left out.
MeshCheck check_mesh(const TriangleMesh& mesh);

// For each vertex the smallest index with a bit-equal position (-0 equals 0).
std::vector<std::uint32_t> joined_vertices(const TriangleMesh& mesh);

}  // namespace talus
