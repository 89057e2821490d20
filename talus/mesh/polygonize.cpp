#include "talus/mesh/polygonize.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "talus/base/error.h"
#include "talus/mesh/cell_triangles.h"

namespace talus {
namespace {

// Where the samples a at 0 and b at 1, of different sign, cross zero.
float crossing(float a, float b) {
  return std::clamp(a / (a - b), kPolygonizeMargin, 1 - kPolygonizeMargin);
}

// Strides of a grid along x, y, z.
std::array<std::size_t, 3> strides(const Int3& size) {
  return {1, static_cast<std::size_t>(size.x),
          static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
}

// Finds the positive corners of every cell, and the cells that have both kinds; cell i has sample i
// as its corner 0. Samples on the far border begin no such cell.
void classify_cells(const GridView& grid, PolygonizeScratch& scratch) {
  const auto stride = strides(grid.size);
  const std::size_t count = grid.values.size();
  scratch.inside.resize(count);
  scratch.cells.assign(count, 0);
  scratch.crossed.assign(count, 0);
  const float* const value = grid.values.data();
  std::uint8_t* const in = scratch.inside.data();
  for (std::size_t i = 0; i < count; ++i) in[i] = value[i] > 0;
  std::uint8_t* const cells = scratch.cells.data();
  const std::size_t dy = stride[1], dz = stride[2], last = count - (1 + dy + dz);
  for (std::size_t i = 0; i < last; ++i)
    cells[i] = static_cast<std::uint8_t>(
        in[i] | in[i + 1] << 1 | in[i + dy] << 2 | in[i + dy + 1] << 3 | in[i + dz] << 4 |
        in[i + dz + 1] << 5 | in[i + dz + dy] << 6 | in[i + dz + dy + 1] << 7);
  std::uint8_t* const crossed = scratch.crossed.data();
  for (std::size_t i = 0; i < last; ++i) crossed[i] = (cells[i] != 0) & (cells[i] != 255);
  scratch.crossed_bits.assign(scratch.crossed);
}

// One vertex on every grid edge whose ends differ in sign; it belongs to the cell it starts.
void add_vertices(const GridView& grid, PolygonizeScratch& scratch, TriangleMesh& mesh) {
  const auto stride = strides(grid.size);
  const float* const value = grid.values.data();
  scratch.edge_vertices.resize(3 * grid.values.size());
  scratch.positions.clear();
  Int3 row(0);  // its first sample, and the index of the next row's
  std::size_t row_end = stride[1];
  scratch.crossed_bits.for_each([&](std::size_t i) {
    for (; i >= row_end; row_end += stride[1])
      if (++row.y == grid.size.y) row = Int3(0, 0, row.z + 1);
    const std::size_t positive = scratch.cells[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t end = 1u << axis;
      if ((positive & 1) == (positive >> end & 1)) continue;
      Vec3f position(row.x + static_cast<int>(i + stride[1] - row_end), row.y, row.z);
      position[static_cast<int>(axis)] += crossing(value[i], value[i + stride[axis]]);
      scratch.edge_vertices[3 * i + axis] = static_cast<std::uint32_t>(scratch.positions.size());
      scratch.positions.push_back(position);
    }
  });
  mesh.positions = scratch.positions;
}

void add_triangles(const GridView& grid, const PolygonizeScratch& scratch, TriangleMesh& mesh) {
  const auto stride = strides(grid.size);
  std::array<std::size_t, 12> edge_offset;
  for (std::size_t e = 0; e < 12; ++e) {
    const auto corner = static_cast<std::size_t>(kCellEdges[e].corner);
    edge_offset[e] = 3 * ((corner & 1) * stride[0] + (corner >> 1 & 1) * stride[1] +
                          (corner >> 2 & 1) * stride[2]) +
                     static_cast<std::size_t>(kCellEdges[e].axis);
  }
  std::size_t corners = 0;
  scratch.crossed_bits.for_each(
      [&](std::size_t i) { corners += cell_triangles(scratch.cells[i]).size(); });
  mesh.triangles.resize(corners / 3);
  Triangle* out = mesh.triangles.data();
  scratch.crossed_bits.for_each([&](std::size_t i) {
    const std::uint32_t* const vertices = &scratch.edge_vertices[3 * i];
    const std::span<const std::uint8_t> edges = cell_triangles(scratch.cells[i]);
    for (std::size_t k = 0; k < edges.size(); k += 3)
      *out++ = {vertices[edge_offset[edges[k]]], vertices[edge_offset[edges[k + 1]]],
                vertices[edge_offset[edges[k + 2]]]};
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
