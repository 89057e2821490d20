#include "talus/mesh/polygonize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <type_traits>

#include "talus/base/error.h"
#include "talus/base/lanes.h"
#include "talus/mesh/cell_triangles.h"
#include "talus/mesh/grid_blur.h"

namespace talus {
namespace {

// Steps between the samples of a grid along x, y, z.
std::array<std::size_t, 3> strides(const Int3& size) {
  return {1, static_cast<std::size_t>(size.x),
          static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
}

// The triangles of a cell, three edges each.
struct CellTriangles {
  static constexpr std::size_t kMax = 5;
  std::array<std::uint8_t, 3 * kMax> edges{};
  std::uint8_t count = 0;
};

const std::array<CellTriangles, 256>& all_cell_triangles() {
  static const auto table = [] {
    std::array<CellTriangles, 256> t;
    for (std::size_t cell = 0; cell < t.size(); ++cell) {
      const std::span<const std::uint8_t> edges = cell_triangles(static_cast<std::uint8_t>(cell));
      TALUS_ASSERT(edges.size() <= t[cell].edges.size());
      std::copy(edges.begin(), edges.end(), t[cell].edges.begin());
      t[cell].count = static_cast<std::uint8_t>(edges.size() / 3);
    }
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
        count_(grid.values.size()),
        per_x_(1.0 / grid.size.x),
        per_y_(1.0 / grid.size.y) {}

  TriangleMesh mesh() {
    find_crossed_edges();
    smooth_samples();
    const std::size_t vertices = make_room_for_vertices();
    add_vertices<2>(add_vertices<1>(add_vertices<0>(0)));
    const std::size_t triangles = add_triangles();
    const auto copy = [](const auto& made, std::size_t count) {
      return std::decay_t<decltype(made)>(made.data(), made.data() + count);
    };
    return {.positions = copy(scratch_.positions, vertices),
            .normals = copy(scratch_.normals, vertices),
            .triangles = copy(scratch_.triangles, triangles)};
  }

 private:
  void find_crossed_edges() {
    const std::size_t count = count_;
    scratch_.inside.resize(count);
    const float* const value = grid_.values.data();
    std::uint8_t* const inside = scratch_.inside.data();
    for (std::size_t i = 0; i < count; ++i) inside[i] = value[i] > 0;
    GridBits& bits = scratch_.inside_bits;
    bits.assign(scratch_.inside);
    for (std::size_t axis = 0; axis < 3; ++axis)
      scratch_.crossed[axis].make(count - stride_[axis], [&](std::size_t i) {
        return bits.word_at(i) ^ bits.word_at(i + stride_[axis]);
      });
  }

  // Two more layers at either end let the gradient be taken everywhere.
  void smooth_samples() {
    scratch_.smooth.resize(count_ + 2 * margin_);
    const auto begin = scratch_.smooth.begin() + static_cast<std::ptrdiff_t>(margin_);
    std::fill(scratch_.smooth.begin(), begin, -1.0f);
    std::fill(std::copy(grid_.values.begin(), grid_.values.end(), begin), scratch_.smooth.end(),
              -1.0f);
    blur(grid_.size + Int3(0, 0, 4), scratch_.smooth, scratch_.smooth_scratch);
  }

  // Returns how many there will be.
  std::size_t make_room_for_vertices() {
    std::size_t count = 0;
    for (const GridBits& crossed : scratch_.crossed) count += crossed.count();
    // They are made kLanes at a time.
    if (count + kLanes > scratch_.positions.size()) {
      scratch_.positions.resize(count + kLanes);
      scratch_.normals.resize(count + kLanes);
    }
    return count;
  }

  // One vertex on every grid edge along an axis whose ends differ in sign, numbered from `first`
  // on; returns the next number.
  template <int axis>
  std::size_t add_vertices(std::size_t first) {
    std::vector<std::int32_t>& places = scratch_.places;
    scratch_.crossed[axis].list(places);
    const std::size_t count = places.size();
    scratch_.edge_vertices[axis].resize(count_);
    std::uint32_t* const vertices = scratch_.edge_vertices[axis].data();
    for (std::size_t k = 0; k < count; ++k)
      vertices[places[k]] = static_cast<std::uint32_t>(first + k);

    places.resize((count + kLanes - 1) / kLanes * kLanes, 0);
    for (std::size_t k = 0; k < count; k += kLanes) make_vertices<axis>(&places[k], first + k);
    return first + count;
  }

  // The vertices on kLanes edges along an axis that begin at `places`.
  template <int axis>
  void make_vertices(const std::int32_t* places, std::size_t first) {
    const Floats a = gather(grid_.values.data(), places);
    const Floats b = gather(grid_.values.data() + stride_[axis], places);
    Floats t = a / (a - b);
    t = t < kPolygonizeMargin ? Floats{} + kPolygonizeMargin : t;
    t = t > 1 - kPolygonizeMargin ? Floats{} + (1 - kPolygonizeMargin) : t;

    Floats position[3], normal[3];
    find_samples(places, position);
    position[axis] += t;
    const float* const smooth = &scratch_.smooth[margin_];
    for (std::size_t i = 0; i < 3; ++i) {
      position[i] = (position[i] + grid_.origin[static_cast<int>(i)]) * grid_.spacing;
      const float *const before = smooth - stride_[i], *const after = smooth + stride_[i];
      normal[i] =
          (1 - t) * (gather(before, places) - gather(after, places)) +
          t * (gather(before + stride_[axis], places) - gather(after + stride_[axis], places));
    }
    const Floats length2 = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const Floats per_length = length2 > 0 ? 1 / sqrt(length2) : Floats{};
    const Floats upward = length2 > 0 ? normal[2] * per_length : Floats{} + 1;
    for (std::size_t k = 0; k < kLanes; ++k) {
      scratch_.positions[first + k] = {position[0][k], position[1][k], position[2][k]};
      scratch_.normals[first + k] = {normal[0][k] * per_length[k], normal[1][k] * per_length[k],
                                     upward[k]};
    }
  }

  // Coordinates of samples.
  void find_samples(const std::int32_t* places, Floats (&at)[3]) const {
    for (std::size_t k = 0; k < kLanes; ++k) {
      // Half a sample more keeps quotients away from whole numbers.
      const auto row = static_cast<std::int32_t>((places[k] + 0.5) * per_x_);
      const auto layer = static_cast<std::int32_t>((row + 0.5) * per_y_);
      at[0][k] = static_cast<float>(places[k] - row * grid_.size.x);
      at[1][k] = static_cast<float>(row - layer * grid_.size.y);
      at[2][k] = static_cast<float>(layer);
    }
  }

  // Cell i has sample i as its corner 0; samples on the far border begin no cell with a surface.
  void find_crossed_cells() {
    const std::size_t dy = stride_[1], dz = stride_[2], end = count_ - (1 + dy + dz);
    scratch_.square.resize(count_);
    scratch_.cells.resize(count_);
    const std::uint8_t* const in = scratch_.inside.data();
    std::uint8_t *const cells = scratch_.cells.data(), *const square = scratch_.square.data();
    for (std::size_t i = 0; i < end + dz; ++i)
      square[i] =
          static_cast<std::uint8_t>(in[i] + 2 * in[i + 1] + 4 * in[i + dy] + 8 * in[i + dy + 1]);
    for (std::size_t i = 0; i < end; ++i)
      cells[i] = static_cast<std::uint8_t>(square[i] + 16 * square[i + dz]);

    const GridBits& bits = scratch_.inside_bits;
    scratch_.crossed_cells.make(end, [&](std::size_t i) {
      std::uint64_t any = 0, all = ~any;
      for (const std::size_t corner : {std::size_t{0}, dy, dz, dy + dz}) {
        const std::uint64_t low = bits.word_at(i + corner), high = bits.word_at(i + corner + 1);
        any |= low | high;
        all &= low & high;
      }
      return any & ~all;
    });
  }

  // Returns their number.
  std::size_t add_triangles() {
    find_crossed_cells();
    // Where a cell finds the vertex of each of its edges.
    std::array<const std::uint32_t*, 12> vertex_of;
    for (std::size_t e = 0; e < 12; ++e) {
      const auto corner = static_cast<std::size_t>(kCellEdges[e].corner);
      const auto axis = static_cast<std::size_t>(kCellEdges[e].axis);
      vertex_of[e] = scratch_.edge_vertices[axis].data() + (corner & 1) +
                     (corner >> 1 & 1) * stride_[1] + (corner >> 2 & 1) * stride_[2];
    }
    const std::array<CellTriangles, 256>& table = all_cell_triangles();
    const std::uint8_t* const cells = scratch_.cells.data();
    scratch_.crossed_cells.list(scratch_.places);
    const std::size_t room = scratch_.places.size() * CellTriangles::kMax;
    if (room > scratch_.triangles.size()) scratch_.triangles.resize(room);
    Triangle* const triangles = scratch_.triangles.data();
    Triangle* next = triangles;
    for (const std::int32_t i : scratch_.places) {
      const CellTriangles& cell = table[cells[i]];
      const auto add = [&](std::size_t k) {
        const std::uint8_t* const e = &cell.edges[3 * k];
        next[k] = {vertex_of[e[0]][i], vertex_of[e[1]][i], vertex_of[e[2]][i]};
      };
      // Most cells have one or two: there is room for both.
      add(0);
      add(1);
      for (std::size_t k = 2; k < cell.count; ++k) add(k);
      next += cell.count;
    }
    return static_cast<std::size_t>(next - triangles);
  }

  const GridView& grid_;
  PolygonizeScratch& scratch_;
  std::array<std::size_t, 3> stride_;
  std::size_t margin_, count_;
  double per_x_, per_y_;  // one by the grid's size
};

}  // namespace

TriangleMesh polygonize(const GridView& grid, PolygonizeScratch& scratch) {
  TALUS_ASSERT(grid.values.size() == strides(grid.size)[2] * static_cast<std::size_t>(grid.size.z));
  TALUS_ASSERT(std::min({grid.size.x, grid.size.y, grid.size.z}) >= 2);
  return Polygonizer(grid, scratch).mesh();
}

}  // namespace talus
