// The surface inside one cell of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace talus {

// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1). Edge 4 axis + k starts at the k-th
// corner, in increasing order, whose coordinate along the axis is 0.
struct CellEdge {
  int axis;
  int corner;
};

inline constexpr std::array<CellEdge, 12> kCellEdges = {{{0, 0},
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

// Three edges per triangle of the surface around the corners whose bits are set in `positive`,
// counter-clockwise seen from the other corners: marching cubes [Lorensen1987] with two rules of
// its own, which make the surface of a whole grid closed and manifold:
//  - on a face with two diagonal positive corners the corners are always separated;
//  - a polygon and its reverse are split along the same diagonals, none of which lies on a face of
//    the cell.
std::span<const std::uint8_t> cell_triangles(std::uint8_t positive);

}  // namespace talus
