// Which stones of a cube lie in a support.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/field/support.h"
#include "talus/piles/cube_stones.h"
#include "talus/piles/pile_params.h"
#include "talus/piles/tiling.h"
#include "talus/piles/voxel_window.h"

namespace talus::piles {

// What all cubes of a pile are chosen by; refers to its parts.
struct ChoiceRule {
  // The part of the world that a cube's stones can reach.
  Box3 reach_of(const Int3& cube) const;

  const Support& support;
  const Support* keep_out;  // or null
  const TileSet& tiles;
  Tiling tiling;
  Membership membership;
  int period;                          // cells along a cube
  double hidden_depth;                 // m
  std::vector<std::uint32_t> anchors;  // per stone, how many; 0 if the stone is empty
  std::vector<std::uint32_t> wanted;   // per stone, how many at least must lie inside
};

ChoiceRule make_rule(const Support& support, const Support* keep_out, const TileSet& tiles,
                     const PileParams& params, const Tiling& tiling);

// Working memory of one thread; quick from one cube to the next of a block (`window_of`).
class CubeChooser {
 public:
  explicit CubeChooser(const ChoiceRule& rule);

  // Sets the bits of a cube's stones that lie in the support and, with none of their anchors, in
  // what is kept out. The other bits must be clear.
  void choose(const Int3& cube, std::span<std::uint64_t> chosen);

  // Voxels of stones of the cube chosen last: of those that are, and of those whose seed lies in
  // the region to fill, which is what they would be if it had no border.
  struct Volume {
    std::uint64_t chosen = 0;
    std::uint64_t seeded = 0;
  };
  const Volume& volume() const { return volume_; }

  // Clears the bits of stones that lie too deep in the support to be seen; returns how many.
  std::uint64_t hide(const Int3& cube, std::span<std::uint64_t> chosen);

 private:
  template <class Test>
  void set_where(std::span<std::uint64_t> chosen, Test&& test);
  void set_all(std::span<std::uint64_t> chosen);
  void keep_out(const Int3& cube, std::span<std::uint64_t> chosen);

  const ChoiceRule& rule_;
  CubeStones stones_;
  VoxelWindow window_;
  std::optional<VoxelWindow> keep_out_window_;
  Volume volume_;
};

}  // namespace talus::piles
