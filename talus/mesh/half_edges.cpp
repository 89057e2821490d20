#include "talus/mesh/half_edges.h"

#include <algorithm>
#include <utility>

namespace talus {

// A counting sort by the lower vertex; the few edges that leave one vertex are then compared.
std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> end;  // per vertex, of the edges whose lower vertex it is
  const auto for_each_side = [&](auto&& use) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
        use(HalfEdge{std::min(a, b), std::max(a, b), t, a < b});
      }
  };
  for_each_side([&](const HalfEdge& side) {
    if (side.low >= end.size()) end.resize(side.low + std::size_t{1}, 0);
    ++end[side.low];
  });
  std::uint32_t placed = 0;
  for (std::uint32_t& e : end) placed += std::exchange(e, placed);

  std::vector<HalfEdge> edges(3 * triangles.size());
  for_each_side([&](const HalfEdge& side) { edges[end[side.low]++] = side; });
  std::size_t begin = 0;
  for (const std::uint32_t e : end) {
    std::sort(edges.begin() + begin, edges.begin() + e, [](const HalfEdge& a, const HalfEdge& b) {
      return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    begin = e;
  }
  return edges;
}

}  // namespace talus
