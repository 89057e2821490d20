// The surface of a solid given by samples on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "talus/mesh/grid_bits.h"
#include "talus/mesh/triangle_mesh.h"

namespace talus {

// At least two samples along each axis, less than 2^31 in all: that at ((x, y, z) + origin) spacing
// is `values[x + size.x (y + size.y z)]`; positive is inside, and no sample on the border may be.
struct GridView {
  Int3 size;
  std::span<const float> values;
  Vec3f origin{0};
  float spacing = 1;
};

// Reusable working memory for `polygonize`.
struct PolygonizeScratch {
  std::vector<std::uint8_t> inside;  // per sample, 1 if positive
  std::vector<std::uint8_t> square;  // per sample, the positive corners of its cell's lower face
  std::vector<std::uint8_t> cells;   // per sample, the positive corners of its cell
  GridBits inside_bits;
  std::array<GridBits, 3> crossed;  // per axis, the edges that the surface crosses
  GridBits crossed_cells;
  std::vector<float> smooth;
  std::vector<float> smooth_scratch;
  std::vector<std::int32_t> places;                         // of crossed edges or cells
  std::array<std::vector<std::uint32_t>, 3> edge_vertices;  // per axis and sample
  // The mesh to be; these only grow.
  std::vector<Vec3f> positions, normals;
  std::vector<Triangle> triangles;
};

// Triangles of the surface where the samples, linear along grid edges, cross zero: marching cubes
// [Lorensen1987] with two rules of its own, so that two solids whose samples never sum above zero
// are disjoint on every face of a cell, and overlap inside a cell rarely and by less than its edge:
//  - on a face with two diagonal positive corners the corners are always separated;
//  - a polygon and its reverse are split along the same diagonals, none of which lies on a face of
//    the cell.
// The result is closed, manifold, and faces outward. Vertices stay
// `kPolygonizeMargin` of a grid edge away from the samples, so that no two of them coincide.
// Normals point against the gradient of the samples, smoothed over
// neighbors; samples that saturate symmetrically about 0 do not disturb them much.
TriangleMesh polygonize(const GridView& grid, PolygonizeScratch& scratch);

inline constexpr float kPolygonizeMargin = 1.0f / 256;

}  // namespace talus
