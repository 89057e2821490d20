#include "talus/mesh/check.h"

#include <algorithm>
#include <array>
#include <bit>

#include "talus/base/hash.h"
#include "talus/base/union_find.h"
#include "talus/mesh/half_edges.h"

namespace talus {
namespace {

// Corners (3 t + c) around one vertex are joined across the edges that leave it; a vertex with more
// than one set of corners is where fans merely touch.
std::uint64_t count_split_vertices(const std::vector<Triangle>& triangles,
                                   const std::vector<HalfEdge>& edges, std::size_t vertex_count) {
  UnionFind corners(3 * triangles.size());
  const auto corner = [&](std::uint32_t t, std::uint32_t v) {
    const Triangle& tri = triangles[t];
    return 3 * t + (tri.x == v ? 0u : tri.y == v ? 1u : 2u);
  };
  for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
    for (const HalfEdge& side : edge.subspan(1))
      for (const std::uint32_t v : {side.low, side.high})
        corners.join(corner(side.triangle, v), corner(edge[0].triangle, v));
  });
  std::vector<std::uint32_t> fans(vertex_count, 0);
  for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c)
    if (corners.root(c) == c) ++fans[triangles[c / 3][static_cast<int>(c % 3)]];
  return static_cast<std::uint64_t>(
      std::count_if(fans.begin(), fans.end(), [](std::uint32_t n) { return n > 1; }));
}

}  // namespace

// A table of vertices, half of it empty: whoever comes first to a position stays.
std::vector<std::uint32_t> joined_vertices(const TriangleMesh& mesh) {
  // Bits are equal where floats may not be: a mesh from outside can hold numbers that are none.
  const auto key = [&](std::uint32_t i) {
    const Vec3f p = mesh.positions[i] + Vec3f(0.0f);  // -0 becomes 0
    return std::array{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                      std::bit_cast<std::uint32_t>(p.z)};
  };
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), kNone);
  const std::size_t mask = table.size() - 1;
  std::vector<std::uint32_t> joined(mesh.positions.size());
  for (std::uint32_t i = 0; i < joined.size(); ++i) {
    const auto k = key(i);
    std::size_t slot = mix_bits(mix_bits(k[0] | std::uint64_t{k[1]} << 32) + k[2]) & mask;
    while (table[slot] != kNone && key(table[slot]) != k) slot = (slot + 1) & mask;
    if (table[slot] == kNone) table[slot] = i;
    joined[i] = table[slot];
  }
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

  const std::vector<HalfEdge> edges = sorted_half_edges(triangles);
  for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
    result.boundary_edges += edge.size() == 1;
    result.non_manifold_edges += edge.size() > 2;
    const auto forward =
        std::count_if(edge.begin(), edge.end(), [](const HalfEdge& side) { return side.forward; });
    result.unbalanced_edges += 2 * static_cast<std::size_t>(forward) != edge.size();
    result.misoriented_edges += edge.size() == 2 && edge[0].forward == edge[1].forward;
  });
  result.non_manifold_vertices = count_split_vertices(triangles, edges, mesh.positions.size());
  return result;
}

}  // namespace talus
