// Where the cubes of a tiling lie in the world.
#pragma once

#include <glm/mat3x3.hpp>

#include "talus/base/vec.h"

namespace talus {

// A lattice of cubic cells, turned, then moved: cell (0, 0, 0) has its lower corner at `origin`.
struct Tiling {
  Vec3 origin{0};
  glm::dmat3 turn{1};    // a rotation
  double cell_size = 1;  // m

  // The place of a point given in cells.
  Vec3 world(const Vec3& at) const { return origin + turn * (cell_size * at); }
  // The axis-aligned box around a box given in cells.
  Box3 world(const Box3& cells) const {
    Box3 box;
    for (int corner = 0; corner < 8; ++corner)
      box.include(
          world(Vec3(corner & 1 ? cells.max.x : cells.min.x, corner & 2 ? cells.max.y : cells.min.y,
                     corner & 4 ? cells.max.z : cells.min.z)));
    return box;
  }
};

// Cubes of a tiling from `first` on.
struct CubeBox {
  Int3 first{0};
  Int3 size{0};

  bool contains(const Int3& cube) const {
    for (int axis = 0; axis < 3; ++axis)
      if (cube[axis] < first[axis] || cube[axis] >= first[axis] + size[axis]) return false;
    return true;
  }
  CubeBox expanded(int cubes) const { return {first - cubes, size + 2 * cubes}; }
  double volume() const { return static_cast<double>(size.x) * size.y * size.z; }
  bool operator==(const CubeBox&) const = default;
};

// The order in which piles keep cubes and cells.
inline bool is_before(const Int3& a, const Int3& b) {
  return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace talus
