// A piece of a tiling with random corner colors, for checking tiles against each other.
#pragma once

#include <array>

#include "talus/base/hash.h"
#include "talus/rocks/stone_grid.h"

namespace talus::test {

// Cells of the infinite lattice; chance in corner colors depends on `seed` alone.
class Tiling {
 public:
  Tiling(const TileParams& params, std::uint64_t seed)
      : params_(params), layout_(params), seed_(seed) {}

  Int3 cube_of(const Int3& cell) const {
    const int p = layout_.period();
    return {floor_div(cell.x, p), floor_div(cell.y, p), floor_div(cell.z, p)};
  }
  Int3 local(const Int3& cell) const { return cell - layout_.period() * cube_of(cell); }
  CornerColors corners(const Int3& cell) const {
    return corner_colors(params_, seed_, cube_of(cell));
  }
  // Number of the colors around `cell` at a box of its cube's corners.
  std::uint32_t code(const Int3& cell, const rocks::CornerBox& box) const {
    const CornerColors colors = corners(cell);
    return rocks::color_code(box, layout_.colors, [&](const Int3& c) {
      return colors[static_cast<std::size_t>(c.x + 2 * c.y + 4 * c.z)];
    });
  }
  std::span<const rocks::Seed> seeds(const rocks::SeedTable& table, const Int3& cell) const {
    return table.seeds(local(cell), code(cell, layout_.seed_corners(local(cell))));
  }
  rocks::StoneKey key(const Int3& cell, std::uint16_t seed) const {
    return {local(cell), code(cell, layout_.stone_corners(local(cell))), seed};
  }

 private:
  TileParams params_;
  rocks::CellLayout layout_;
  std::uint64_t seed_;
};

// Calls `use(cell)` for all cells with first <= cell < last.
void for_each_cell(const Int3& first, const Int3& last, auto&& use) {
  for (int z = first.z; z < last.z; ++z)
    for (int y = first.y; y < last.y; ++y)
      for (int x = first.x; x < last.x; ++x) use(Int3(x, y, z));
}

// Parameters that differ in every respect the construction must not care about. Coarse, for speed.
inline TileParams varied_params(int variant) {
  TileParams p;
  p.variety = std::array{Variety::aperiodic, Variety::columns,
                         Variety::periodic}[static_cast<std::size_t>(variant / 3 % 3)];
  p.n = 5 + variant % 3;
  p.voxels_per_edge = p.n * (p.n == 5 ? 6 : 4);
  p.size_ratio = variant % 4 == 0 ? 1 : 4;
  p.seeds_min = 1;
  p.seeds_max = variant % 5 == 4 ? 4 : 1;
  if (variant % 3 == 2) p.axis_z = {0.3, 0.5};
  p.weathering.depth = 0.05 * (variant % 4);
  return p;
}

}  // namespace talus::test
