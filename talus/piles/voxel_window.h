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

 private:
  struct Count {
    std::uint64_t inside = 0;
    std::uint64_t open = 0;  // that may be inside
  };
  Count count(const StoneSolid& solid, const Int3& at) const;
  void classify_bricks(const Int3& begin, const Int3& end);
  void classify_brick(const Int3& begin);
  void resolve(const Int3& begin, const Int3& end);
  void set(std::vector<std::uint64_t>& bits, const Int3& begin, int edge) const;
  std::size_t row(int y, int z) const {
    return row_words_ * static_cast<std::size_t>(y + voxels_ * z);
  }
  std::size_t leaf(const Int3& voxel) const;
  Vec3 center(const Vec3& voxel) const;
  BoxState classify(const Int3& begin, int edge, const Vec3& half) const;

  int voxels_per_cell_;
  int period_;
  int margin_;  // voxels around the block
  int voxels_;  // along the window: a multiple of a brick's
  std::size_t row_words_;
  std::vector<std::uint64_t> inside_, open_;  // one bit for each voxel, row by row
  std::vector<std::uint8_t> is_known_;        // per brick, whether it was asked for
  std::vector<std::uint8_t> is_open_;         // per leaf of a brick, whether its voxels are
  const Support& support_;
  const Tiling& tiling_;
  std::optional<Int3> window_;   // the block of cubes
  Int3 cube_{0};                 // where the present cube begins, voxels
  Vec3 first_{0};                // center of its first voxel
  std::array<Vec3, 3> step_;     // from a center to the next along each axis
  Vec3 half_brick_, half_leaf_;  // half the boxes around their centers of voxels
};

}  // namespace talus::piles
