// Which voxels in and around a few cubes of a tiling lie in a support.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "talus/field/support.h"
#include "talus/piles/tiling.h"
#include "talus/rocks/tile_set.h"

namespace talus::piles {

// Cubes along a block of cubes that share a window, and with it the voxels between them.
inline constexpr int kWindowCubes = 2;
inline Int3 window_of(const Int3& cube) {
  return {floor_div(cube.x, kWindowCubes), floor_div(cube.y, kWindowCubes),
          floor_div(cube.z, kWindowCubes)};
}

// What is known of each voxel that a stone of a block of cubes can have. The support is asked for
// boxes of voxels first, and for single ones only where a stone's answer hangs on them. Block and
// support decide what it holds, so that it forgets nothing on the way through a block.
class VoxelWindow {
 public:
  // All but the window's cube must live as long.
  VoxelWindow(const TileSet& tiles, const Support& support, const Tiling& tiling);

  // Turns to a cube.
  void go_to(const Int3& cube);

  // Whether at least `wanted` of the `all` centers of voxels of a stone lie in the support; it is
  // seeded in `cell`, which is relative to the cube. The answer is that of asking for each center,
  // and depends on the place alone.
  bool holds(const StoneSolid& solid, const Int3& cell, std::uint64_t wanted, std::uint64_t all);

  // Whether a point lies in the support; in cells from the corner of the cell that holds it.
  bool contains(const Int3& cell, const Vec3& position);

 private:
  enum class Brick : std::uint8_t { unknown, inside, outside, mixed, in_pairs };
  struct Count {
    std::uint64_t all = 0;
    std::uint64_t inside = 0;
    std::uint64_t open = 0;  // that may be inside
  };
  Count count_slices(const StoneSolid& solid, const Int3& at, int z_begin, int z_end) const;
  BoxState classify_bricks(const Int3& begin, const Int3& end);
  void classify_group(const Int3& group);
  void classify_pairs(const Int3& begin);
  void resolve(const Int3& begin, const Int3& end, int z);
  void resolve_leaf(const Int3& begin);
  std::size_t row(int y, int z) const {
    return row_words_ * static_cast<std::size_t>(y + voxels_ * z);
  }
  std::size_t word(const Int3& voxel) const {
    return row(voxel.y, voxel.z) + static_cast<std::size_t>(voxel.x) / 64;
  }
  std::size_t leaf(const Int3& voxel) const;
  Brick& brick(const Int3& at);
  Vec3 center(const Vec3& voxel) const;
  // Centers this many voxels apart.
  PointBlock block(const Vec3& first, int apart) const;

  int voxels_per_cell_;
  int period_;
  int margin_;  // voxels around the block
  int voxels_;  // along the window: a multiple of a brick's
  std::size_t row_words_;
  std::vector<std::uint64_t> inside_, open_;  // one bit for each voxel, row by row
  std::vector<Brick> bricks_;
  std::vector<std::uint8_t> is_open_;  // per leaf of a brick, whether its voxels are
  const Support& support_;
  const Tiling& tiling_;
  std::optional<Int3> window_;  // the block of cubes
  Int3 first_cell_{0};          // of the present cube
  Int3 cube_{0};                // where it begins, voxels
  Vec3 first_{0};               // center of its first voxel
  Vec3 farthest_{0};            // that a coordinate is from the origin
  std::array<Vec3, 3> step_;    // from a center to the next along each axis
  Vec3 half_brick_;             // half the box around a brick
  Vec3 half_pair_;              // and around a pair's centers of voxels
};

}  // namespace talus::piles
