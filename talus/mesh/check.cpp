#include "talus/mesh/check.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace talus {
namespace {

struct HalfEdge {
  std::uint32_t low, high;  // end points, low < high
  std::uint32_t triangle;
  bool forward;  // the triangle runs from low to high

  bool same_edge(const HalfEdge& o) const { return low == o.low && high == o.high; }
};

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Corners (3 t + c) around one vertex are joined across the two-sided edges that leave it; a vertex
// with more than one class of corners is where fans merely touch.
std::uint64_t count_split_vertices(const std::vector<Triangle>& triangles,
                                   const std::vector<HalfEdge>& edges, std::size_t vertex_count) {
  std::vector<std::uint32_t> parent(3 * triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto corner = [&](std::uint32_t t, std::uint32_t v) {
    const Triangle& tri = triangles[t];
    return 3 * t + (tri.x == v ? 0u : tri.y == v ? 1u : 2u);
  };
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].same_edge(edges[i])) ++end;
    for (std::size_t k = i + 1; k < end; ++k)
      for (const std::uint32_t v : {edges[i].low, edges[i].high})
        parent[root(parent, corner(edges[k].triangle, v))] =
            root(parent, corner(edges[i].triangle, v));
    i = end;
  }
  std::vector<std::uint32_t> fans(vertex_count, 0);
  for (std::uint32_t c = 0; c < parent.size(); ++c)
    if (root(parent, c) == c) ++fans[triangles[c / 3][static_cast<int>(c % 3)]];
  return static_cast<std::uint64_t>(
      std::count_if(fans.begin(), fans.end(), [](std::uint32_t n) { return n > 1; }));
}

}  // namespace

std::vector<std::uint32_t> joined_vertices(const TriangleMesh& mesh) {
  const auto key = [&](std::uint32_t i) {
    const Vec3f p = mesh.positions[i] + Vec3f(0.0f);  // -0 becomes 0
    return std::array{p.x, p.y, p.z};
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::uint32_t> joined(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    joined[order[i]] =
        i > 0 && key(order[i]) == key(order[i - 1]) ? joined[order[i - 1]] : order[i];
  return joined;
}

MeshCheck check_mesh(const TriangleMesh& mesh) {
  MeshCheck result;
  result.triangles = mesh.triangles.size();
  const std::vector<std::uint32_t> joined = joined_vertices(mesh);
  for (std::uint32_t i = 0; i < joined.size(); ++i) result.vertices += joined[i] == i;

  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Triangle j(joined[t.x], joined[t.y], joined[t.z]);
    if (j.x == j.y || j.y == j.z || j.z == j.x)
      ++result.degenerate;
    else
      triangles.push_back(j);
  }

  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].same_edge(edges[i])) ++end;
    result.boundary_edges += end - i == 1;
    result.non_manifold_edges += end - i > 2;
    result.misoriented_edges += end - i == 2 && edges[i].forward == edges[i + 1].forward;
    i = end;
  }
  result.non_manifold_vertices = count_split_vertices(triangles, edges, mesh.positions.size());
  return result;
}

}  // namespace talus
