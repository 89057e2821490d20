// Which triangles meet along an edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// One side of a triangle, between vertices `low` < `high`.
struct HalfEdge {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool forward;  // the triangle runs from low to high
};

// The sides of all triangles; those along one edge are next to each other, by increasing triangle.
std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles);

// Calls `use(span of half edges)` for each edge.
void for_each_edge(std::span<const HalfEdge> edges, auto&& use) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high)
      ++end;
    use(edges.subspan(i, end - i));
    i = end;
  }
}

}  // namespace talus
