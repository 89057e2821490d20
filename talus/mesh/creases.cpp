#include "talus/mesh/creases.h"

#include <glm/geometric.hpp>
#include <limits>

#include "talus/base/angle.h"
#include "talus/base/union_find.h"
#include "talus/mesh/half_edges.h"

namespace talus {
namespace {

// Normals as long as the triangles are large.
std::vector<Vec3> face_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    normals.push_back(glm::cross(b - a, c - a));
  }
  return normals;
}

// Number of the triangle's corner at a vertex, among those of all triangles.
std::uint32_t corner_at(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
  const Triangle& t = mesh.triangles[triangle];
  return 3 * triangle + (t.x == vertex ? 0 : t.y == vertex ? 1 : 2);
}

}  // namespace

TriangleMesh with_creased_normals(const TriangleMesh& mesh, double angle_deg) {
  const std::vector<Vec3> normals = face_normals(mesh);
  const double least = cos_deg(angle_deg);

  // Corners of a vertex that smooth edges connect are one vertex.
  UnionFind corners(3 * mesh.triangles.size());
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
  for_each_edge(edges, [&](std::span<const HalfEdge> sides) {
    if (sides.size() != 2 || sides[0].forward == sides[1].forward) return;
    const std::uint32_t a = sides[0].triangle, b = sides[1].triangle;
    if (glm::dot(normals[a], normals[b]) <
        least * glm::length(normals[a]) * glm::length(normals[b]))
      return;
    for (const std::uint32_t vertex : {sides[0].low, sides[0].high})
      corners.join(corner_at(mesh, a, vertex), corner_at(mesh, b, vertex));
  });

  TriangleMesh creased;
  std::vector<Vec3> sums;  // by vertex
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertex_of(3 * mesh.triangles.size(), kNone);  // by a set's root
  creased.triangles.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle;
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& vertex = vertex_of[corners.root(3 * t + static_cast<std::uint32_t>(c))];
      if (vertex == kNone) {
        const std::uint32_t from = mesh.triangles[t][c];
        vertex = static_cast<std::uint32_t>(creased.positions.size());
        creased.positions.push_back(mesh.positions[from]);
        sums.push_back(Vec3(0));
        if (!mesh.shares.empty()) creased.shares.push_back(mesh.shares[from]);
      }
      sums[vertex] += normals[t];
      triangle[c] = vertex;
    }
    creased.triangles.push_back(triangle);
  }
  creased.normals.reserve(sums.size());
  for (const Vec3& sum : sums) {
    const double length = glm::length(sum);
    creased.normals.emplace_back(length > 0 ? sum / length : Vec3(0, 0, 1));
  }
  return creased;
}

}  // namespace talus
