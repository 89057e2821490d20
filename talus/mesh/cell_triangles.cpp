#include "talus/mesh/cell_triangles.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "talus/base/error.h"

namespace talus {
namespace {

// Corners of the six faces, counter-clockwise seen from outside the cell.
constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e) {
    const int start = kCellEdges[static_cast<std::size_t>(e)].corner;
    const int end = start | 1 << kCellEdges[static_cast<std::size_t>(e)].axis;
    if ((start == a && end == b) || (start == b && end == a)) return e;
  }
  TALUS_ASSERT(false);
  return -1;
}

bool on_common_face(int edge_a, int edge_b) {
  const auto ends = [](int e) {
    const CellEdge& edge = kCellEdges[static_cast<std::size_t>(e)];
    return std::array{edge.corner, edge.corner | 1 << edge.axis};
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto on_face = [&](int corner) { return (corner >> axis & 1) == side; };
      const auto a = ends(edge_a), b = ends(edge_b);
      if (on_face(a[0]) && on_face(a[1]) && on_face(b[0]) && on_face(b[1])) return true;
    }
  return false;
}

// Triangles of one polygon of edge vertices with the fewest diagonals on a face of the cell, by
// dynamic programming over its corners; the first such choice in an order that does not depend on
// where the polygon starts or which way it runs.
class PolygonSplitter {
 public:
  explicit PolygonSplitter(std::vector<int> polygon) : polygon_(std::move(polygon)) {
    std::rotate(polygon_.begin(), std::min_element(polygon_.begin(), polygon_.end()),
                polygon_.end());
    reversed_ = polygon_[1] > polygon_.back();
    if (reversed_) std::reverse(polygon_.begin() + 1, polygon_.end());
  }

  void append_to(std::vector<std::uint8_t>& triangles) {
    split(0, polygon_.size() - 1, &triangles);
  }

 private:
  int cost_of_diagonal(std::size_t i, std::size_t j) const {
    const bool is_side = j - i == 1 || (i == 0 && j == polygon_.size() - 1);
    return !is_side && on_common_face(polygon_[i], polygon_[j]);
  }

  // Cheapest split of corners i … j; written to `out` unless null.
  int split(std::size_t i, std::size_t j, std::vector<std::uint8_t>* out) const {
    if (j - i < 2) return 0;
    int best = 1000;
    std::size_t best_k = i + 1;
    for (std::size_t k = i + 1; k < j; ++k) {
      const int cost = split(i, k, nullptr) + split(k, j, nullptr) + cost_of_diagonal(i, k) +
                       cost_of_diagonal(k, j);
      if (cost < best) {
        best = cost;
        best_k = k;
      }
    }
    if (out) {
      split(i, best_k, out);
      split(best_k, j, out);
      const std::size_t second = reversed_ ? j : best_k, third = reversed_ ? best_k : j;
      for (const std::size_t corner : {i, second, third})
        out->push_back(static_cast<std::uint8_t>(polygon_[corner]));
    }
    return best;
  }

  std::vector<int> polygon_;
  bool reversed_ = false;
};

// Three edges per triangle of the surface in a cell whose positive corners are the bits of
// `positive`.
std::vector<std::uint8_t> make_cell_triangles(int positive) {
  const auto inside = [&](int corner) { return (positive >> corner & 1) != 0; };
  // On each face the surface runs from where the boundary enters a run of positive corners to where
  // it leaves it; diagonal corners are runs of their own.
  std::array<int, 12> next;
  next.fill(-1);
  for (const auto& face : kFaces)
    for (std::size_t k = 0; k < 4; ++k) {
      if (!inside(face[k]) || inside(face[(k + 3) % 4])) continue;
      std::size_t last = k;
      while (inside(face[(last + 1) % 4])) ++last;
      const int enter = edge_between(face[(k + 3) % 4], face[k]);
      const int leave = edge_between(face[last % 4], face[(last + 1) % 4]);
      next[static_cast<std::size_t>(enter)] = leave;
    }

  std::vector<std::uint8_t> triangles;
  for (int start = 0; start < 12; ++start) {
    std::vector<int> polygon;
    for (int e = start; next[static_cast<std::size_t>(e)] >= 0;) {
      polygon.push_back(e);
      e = std::exchange(next[static_cast<std::size_t>(e)], -1);
    }
    if (!polygon.empty()) PolygonSplitter(polygon).append_to(triangles);
  }
  return triangles;
}

// The triangles of all 256 cells, one after another: those of cell c are elements first[c] to
// first[c + 1].
struct CellTable {
  std::array<std::uint16_t, 257> first{};
  std::vector<std::uint8_t> edges;
};

const CellTable& cell_table() {
  static const CellTable table = [] {
    CellTable t;
    for (std::size_t positive = 0; positive < 256; ++positive) {
      const std::vector<std::uint8_t> triangles = make_cell_triangles(static_cast<int>(positive));
      t.edges.insert(t.edges.end(), triangles.begin(), triangles.end());
      t.first[positive + 1] = static_cast<std::uint16_t>(t.edges.size());
    }
    return t;
  }();
  return table;
}

}  // namespace

std::span<const std::uint8_t> cell_triangles(std::uint8_t positive) {
  const CellTable& table = cell_table();
  return std::span(table.edges)
      .subspan(table.first[positive], table.first[positive + 1u] - table.first[positive]);
}

}  // namespace talus
