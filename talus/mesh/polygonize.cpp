#include "talus/mesh/polygonize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "talus/base/error.h"
#include "talus/mesh/cell_triangles.h"
#include "talus/mesh/grid_blur.h"

namespace talus {
namespace {

// Where the samples a at 0 and b at 1, of different sign, cross zero.
float crossing(float a, float b) {
  return std::clamp(a / (a - b), kPolygonizeMargin, 1 - kPolygonizeMargin);
}

// Steps between the samples of a grid along x, y, z.
std::array<std::size_t, 3> strides(const Int3& size) {
  return {1, static_cast<std::size_t>(size.x),
          static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
}

using CellTriangles = std::array<std::span<const std::uint8_t>, 256>;

const CellTriangles& all_cell_triangles() {
  static const CellTriangles table = [] {
    CellTriangles t;
    for (std::size_t cell = 0; cell < t.size(); ++cell)
      t[cell] = cell_triangles(static_cast<std::uint8_t>(cell));
    return t;
  }();
  return table;
}

class Polygonizer {
 public:
  Polygonizer(const GridView& grid, PolygonizeScratch& scratch)
      : grid_(grid),
        scratch_(scratch),
        stride_(strides(grid.size)),
        margin_(2 * stride_[2]),
        count_(grid.values.size()) {}

  TriangleMesh mesh() {
    find_crossed_edges();
    smooth_samples();
    add_vertices<0>();
    add_vertices<1>();
    add_vertices<2>();
    add_triangles();
    return std::move(mesh_);
  }

 private:
  void find_crossed_edges() {
    scratch_.inside.resize(count_);
    const float* const value = grid_.values.data();
    std::uint8_t* const inside = scratch_.inside.data();
    for (std::size_t i = 0; i < count_; ++i) inside[i] = value[i] > 0;

    scratch_.marked.assign(count_, 0);
    std::uint8_t* const marked = scratch_.marked.data();
    std::size_t vertices = 0;
    for (const std::size_t axis : {2, 1, 0}) {
      const std::size_t stride = stride_[axis], edges = count_ - stride;
      for (std::size_t i = 0; i < edges; ++i) marked[i] = inside[i] ^ inside[i + stride];
      scratch_.crossed[axis].assign(scratch_.marked);
      vertices += scratch_.crossed[axis].count();
    }
    mesh_.positions.resize(vertices);
    mesh_.normals.resize(vertices);
  }

  // Two more layers at either end let the gradient be taken everywhere.
  void smooth_samples() {
    scratch_.smooth.assign(count_ + 2 * margin_, -1.0f);
    std::copy(grid_.values.begin(), grid_.values.end(),
              scratch_.smooth.begin() + static_cast<std::ptrdiff_t>(margin_));
    blur(grid_.size + Int3(0, 0, 4), scratch_.smooth, scratch_.smooth_scratch);
  }

  // One vertex on every grid edge along an axis whose ends differ in sign.
  template <int axis>
  void add_vertices() {
    const std::size_t stride = stride_[axis];
    scratch_.edge_vertices[axis].resize(count_);
    std::uint32_t* const vertices = scratch_.edge_vertices[axis].data();
    const float *const value = grid_.values.data(), *const smooth = &scratch_.smooth[margin_];
    const auto dy = static_cast<std::ptrdiff_t>(stride_[1]);
    const auto dz = static_cast<std::ptrdiff_t>(stride_[2]);
    const auto outward = [=](const float* s) {
      return Vec3f(s[-1] - s[1], s[-dy] - s[dy], s[-dz] - s[dz]);
    };
    Int3 row(0);                       // the first sample of the current row,
    std::size_t row_end = stride_[1];  // and the index of the next row's
    scratch_.crossed[axis].for_each([&](std::size_t i) {
      for (; i >= row_end; row_end += stride_[1])
        if (++row.y == grid_.size.y) row = Int3(0, 0, row.z + 1);
      const float t = crossing(value[i], value[i + stride]);
      Vec3f position(row.x + static_cast<int>(i + stride_[1] - row_end), row.y, row.z);
      position[axis] += t;
      const Vec3f n = (1 - t) * outward(smooth + i) + t * outward(smooth + i + stride);
      const float length2 = glm::dot(n, n);
      vertices[i] = static_cast<std::uint32_t>(vertex_);
      mesh_.positions[vertex_] = position;
      mesh_.normals[vertex_] = length2 > 0 ? n * (1 / std::sqrt(length2)) : Vec3f(0, 0, 1);
      ++vertex_;
    });
  }

  // Cell i has sample i as its corner 0; samples on the far border begin no cell with a surface.
  void add_triangles() {
    const std::size_t dy = stride_[1], dz = stride_[2], end = count_ - (1 + dy + dz);
    const std::uint8_t* const in = scratch_.inside.data();
    scratch_.cells.resize(count_);
    std::uint8_t *const cells = scratch_.cells.data(), *const marked = scratch_.marked.data();
    for (std::size_t i = 0; i < end; ++i)
      cells[i] = static_cast<std::uint8_t>(
          in[i] | in[i + 1] << 1 | in[i + dy] << 2 | in[i + dy + 1] << 3 | in[i + dz] << 4 |
          in[i + dz + 1] << 5 | in[i + dz + dy] << 6 | in[i + dz + dy + 1] << 7);
    for (std::size_t i = 0; i < end; ++i) marked[i] = (cells[i] != 0) & (cells[i] != 255);
    std::fill(marked + end, marked + count_, std::uint8_t{0});
    scratch_.crossed_cells.assign(scratch_.marked);

    // Where a cell finds the vertex of each of its edges.
    std::array<const std::uint32_t*, 12> vertex_of;
    for (std::size_t e = 0; e < 12; ++e) {
      const auto corner = static_cast<std::size_t>(kCellEdges[e].corner);
      const auto axis = static_cast<std::size_t>(kCellEdges[e].axis);
      vertex_of[e] = scratch_.edge_vertices[axis].data() + (corner & 1) + (corner >> 1 & 1) * dy +
                     (corner >> 2 & 1) * dz;
    }
    const CellTriangles& cell_edges = all_cell_triangles();
    std::size_t corners = 0;
    scratch_.crossed_cells.for_each([&](std::size_t i) { corners += cell_edges[cells[i]].size(); });
    mesh_.triangles.resize(corners / 3);
    Triangle* triangle = mesh_.triangles.data();
    scratch_.crossed_cells.for_each([&](std::size_t i) {
      const std::span<const std::uint8_t> edges = cell_edges[cells[i]];
      const std::uint8_t* const last = edges.data() + edges.size();
      for (const std::uint8_t* e = edges.data(); e != last; e += 3)
        *triangle++ = {vertex_of[e[0]][i], vertex_of[e[1]][i], vertex_of[e[2]][i]};
    });
  }

  const GridView& grid_;
  PolygonizeScratch& scratch_;
  std::array<std::size_t, 3> stride_;
  std::size_t margin_, count_;
  TriangleMesh mesh_;
  std::size_t vertex_ = 0;  // the next
};

}  // namespace

TriangleMesh polygonize(const GridView& grid, PolygonizeScratch& scratch) {
  TALUS_ASSERT(grid.values.size() == strides(grid.size)[2] * static_cast<std::size_t>(grid.size.z));
  TALUS_ASSERT(std::min({grid.size.x, grid.size.y, grid.size.z}) >= 2);
  return Polygonizer(grid, scratch).mesh();
}

}  // namespace talus
