// Which corner colors a piece of a tiling depends on, and numbering by them.
#pragma once

#include <cstddef>

#include "talus/rocks/tile_set.h"

namespace talus::rocks {

// A box of cube corners: per axis the first (0 or 1) and how many (1 or 2).
struct CornerBox {
  Int3 first{0};
  Int3 count{1};

  int corners() const { return count.x * count.y * count.z; }
};

inline std::uint32_t power(int base, int exponent) {
  std::uint32_t result = 1;
  for (int i = 0; i < exponent; ++i) result *= static_cast<std::uint32_t>(base);
  return result;
}

// Number of the colors at a box of corners among all `colors`^corners, x fastest.
// `color_at(Int3 corner)` gives the color at a corner.
std::uint32_t color_code(const CornerBox& box, int colors, auto&& color_at) {
  std::uint32_t code = 0, digit = 1;
  for (int z = 0; z < box.count.z; ++z)
    for (int y = 0; y < box.count.y; ++y)
      for (int x = 0; x < box.count.x; ++x) {
        code += digit * static_cast<std::uint32_t>(color_at(box.first + Int3(x, y, z)));
        digit *= static_cast<std::uint32_t>(colors);
      }
  return code;
}

// Color at one corner of a box whose colors are numbered `code`.
inline int decode_color(const CornerBox& box, int colors, std::uint32_t code, const Int3& corner) {
  const Int3 at = corner - box.first;
  const int index = at.x + box.count.x * (at.y + box.count.y * at.z);
  return static_cast<int>(code / power(colors, index) % static_cast<std::uint32_t>(colors));
}

inline std::uint32_t code_count(const CornerBox& box, int colors) {
  return power(colors, box.corners());
}

// How the cells of a cube depend on its corners. Along an axis the period is n - 1 cells: cell
// n - 1 of a cube is cell 0 of the next.
struct CellLayout {
  int n;
  int colors;           // 1 if no axis is colored
  int radius;           // R: cells on either side of a corner that its color fixes
  int voxels_per_cell;  // v
  Int3 colored;         // 1 along axes with colored corners, 0 where every cube is the same

  explicit CellLayout(const TileParams& p)
      : n(p.n),
        colors(p.variety == Variety::periodic ? 1 : p.colors),
        radius(fixed_radius(p)),
        voxels_per_cell(p.voxels() / p.n),
        colored(!repeats(p.variety, 0), !repeats(p.variety, 1), !repeats(p.variety, 2)) {}

  int period() const { return n - 1; }
  int period_voxels() const { return period() * voxels_per_cell; }
  // rho = R / 2: how far beyond its cell a stone of a corner cell may reach.
  int margin_voxels() const { return radius * voxels_per_cell / 2; }
  // Along an axis that is not colored: how far beyond its cell a stone may reach, which keeps it
  // from its own copies, and how far beyond a cube cells lie whose stones reach into it or touch
  // it.
  int repeat_margin_voxels() const { return (period() - 1) * voxels_per_cell / 2; }
  int repeat_margin_cells() const { return (period() + 1) / 2; }
  std::size_t cell_count() const {
    const auto p = static_cast<std::size_t>(period());
    return p * p * p;
  }
  std::size_t cell_index(const Int3& cell) const {
    return static_cast<std::size_t>(cell.x + period() * (cell.y + period() * cell.z));
  }
  Int3 cell_at(std::size_t index) const {
    const int i = static_cast<int>(index), p = period();
    return {i % p, i / p % p, i / (p * p)};
  }

  // The corner that colors `corner`: the same for all that differ along repeating axes only.
  Int3 colored_corner(const Int3& corner) const { return corner * colored; }

  // Corners that the seeds of a cell depend on.
  CornerBox seed_corners(const Int3& cell) const {
    CornerBox box;
    for (int axis = 0; axis < 3; ++axis) {
      if (!colored[axis]) continue;
      const int l = cell[axis];
      box.first[axis] = l >= period() - radius ? 1 : 0;
      box.count[axis] = l > radius && l < period() - radius ? 2 : 1;
    }
    return box;
  }

  // Corners that the stones of a cell depend on, as far as they can reach.
  CornerBox stone_corners(const Int3& cell) const {
    CornerBox box;
    for (int axis = 0; axis < 3; ++axis) box.count[axis] = colored[axis] && cell[axis] != 0 ? 2 : 1;
    return box;
  }

  // How often a stone of a cell occurs among the tilings' cells at its place in the cube: one in as
  // many as the corners it depends on have colorings.
  double frequency(const Int3& cell) const { return 1.0 / code_count(stone_corners(cell), colors); }
};

}  // namespace talus::rocks
