#include "talus/mesh/polygonize.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "talus/base/error.h"

namespace talus {
namespace {

// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1). Edge 4 axis + k starts at the k-th
// corner, in increasing order, whose coordinate along the axis is 0.
struct CellEdge {
  int axis;
  int corner;
};

constexpr std::array<CellEdge, 12> kEdges = {{{0, 0},
                                              {0, 2},
                                              {0, 4},
                                              {0, 6},
                                              {1, 0},
                                              {1, 1},
                                              {1, 4},
                                              {1, 5},
                                              {2, 0},
                                              {2, 1},
                                              {2, 2},
                                              {2, 3}}};

// Corners of the six faces, counter-clockwise seen from outside the cell.
constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e) {
    const int start = kEdges[static_cast<std::size_t>(e)].corner;
    const int end = start | 1 << kEdges[static_cast<std::size_t>(e)].axis;
    if ((start == a && end == b) || (start == b && end == a)) return e;
  }
  TALUS_ASSERT(false);
  return -1;
}

bool on_common_face(int edge_a, int edge_b) {
  const auto ends = [](int e) {
    const CellEdge& edge = kEdges[static_cast<std::size_t>(e)];
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
std::vector<std::uint8_t> cell_triangles(int positive) {
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
      const std::vector<std::uint8_t> triangles = cell_triangles(static_cast<int>(positive));
      t.edges.insert(t.edges.end(), triangles.begin(), triangles.end());
      t.first[positive + 1] = static_cast<std::uint16_t>(t.edges.size());
    }
    return t;
  }();
  return table;
}

// Where the samples a at 0 and b at 1, of different sign, cross zero.
float crossing(float a, float b) {
  return std::clamp(a / (a - b), kPolygonizeMargin, 1 - kPolygonizeMargin);
}

// Strides of a grid along x, y, z.
std::array<std::size_t, 3> strides(const Int3& size) {
  return {1, static_cast<std::size_t>(size.x),
          static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
}

// The bits of the positive corners of every cell; cell i has sample i as its corner 0. Entries of
// samples on the far border, which begin no cell, are 0.
void classify_cells(const GridView& grid, PolygonizeScratch& scratch) {
  const auto stride = strides(grid.size);
  const std::size_t count = grid.values.size();
  scratch.inside.resize(count);
  scratch.cells.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) scratch.inside[i] = grid.values[i] > 0;
  const std::uint8_t* const in = scratch.inside.data();
  std::uint8_t* const cells = scratch.cells.data();
  const std::size_t dy = stride[1], dz = stride[2], last = count - (1 + dy + dz);
  for (std::size_t i = 0; i < last; ++i)
    cells[i] = static_cast<std::uint8_t>(
        in[i] | in[i + 1] << 1 | in[i + dy] << 2 | in[i + dy + 1] << 3 | in[i + dz] << 4 |
        in[i + dz + 1] << 5 | in[i + dz + dy] << 6 | in[i + dz + dy + 1] << 7);
}

// Calls `use(sample index, position, positive corners)` for the cells that the surface crosses.
void for_each_crossed_cell(const Int3& size, const PolygonizeScratch& scratch, auto&& use) {
  std::size_t i = 0;
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x, ++i) {
        const std::uint8_t positive = scratch.cells[i];
        if (positive != 0 && positive != 255) use(i, Int3(x, y, z), positive);
      }
}

// One vertex on every grid edge whose ends differ in sign; it belongs to the cell it starts.
void add_vertices(const GridView& grid, PolygonizeScratch& scratch, TriangleMesh& mesh) {
  const auto stride = strides(grid.size);
  scratch.edge_vertices.resize(3 * grid.values.size());
  for_each_crossed_cell(grid.size, scratch, [&](std::size_t i, const Int3& p, int positive) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int end = 1 << axis;
      if ((positive & 1) == (positive >> end & 1)) continue;
      Vec3f position(p);
      position[static_cast<int>(axis)] += crossing(grid.values[i], grid.values[i + stride[axis]]);
      scratch.edge_vertices[3 * i + axis] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(position);
    }
  });
}

void add_triangles(const GridView& grid, const PolygonizeScratch& scratch, TriangleMesh& mesh) {
  const auto stride = strides(grid.size);
  std::array<std::size_t, 12> edge_offset;
  for (std::size_t e = 0; e < 12; ++e) {
    const auto corner = static_cast<std::size_t>(kEdges[e].corner);
    edge_offset[e] = 3 * ((corner & 1) * stride[0] + (corner >> 1 & 1) * stride[1] +
                          (corner >> 2 & 1) * stride[2]) +
                     static_cast<std::size_t>(kEdges[e].axis);
  }
  const CellTable& table = cell_table();
  mesh.triangles.reserve(2 * mesh.positions.size());
  for_each_crossed_cell(grid.size, scratch, [&](std::size_t i, const Int3&, std::size_t positive) {
    for (std::size_t k = table.first[positive]; k < table.first[positive + 1]; k += 3) {
      const auto vertex = [&](std::size_t corner) {
        return scratch.edge_vertices[3 * i + edge_offset[table.edges[k + corner]]];
      };
      mesh.triangles.emplace_back(vertex(0), vertex(1), vertex(2));
    }
  });
}

}  // namespace

TriangleMesh polygonize(const GridView& grid, PolygonizeScratch& scratch) {
  TALUS_ASSERT(grid.values.size() == strides(grid.size)[2] * static_cast<std::size_t>(grid.size.z));
  TALUS_ASSERT(std::min({grid.size.x, grid.size.y, grid.size.z}) >= 2);
  classify_cells(grid, scratch);
  TriangleMesh mesh;
  add_vertices(grid, scratch, mesh);
  add_triangles(grid, scratch, mesh);
  return mesh;
}

}  // namespace talus
