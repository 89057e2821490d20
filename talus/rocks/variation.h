// Weathering that is not the same everywhere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/rocks/stone_grid.h"

namespace talus::rocks {

// A factor for each voxel of a stone, between 1 - amount and 1 + amount: half of its deviation is
// the stone's own, half varies smoothly over it. A function of the stone's seed and of the place
// relative to it, hence the same in every tiling, and at every resolution.
class Variation {
 public:
  static constexpr int kOne = 1024;

  explicit Variation(double amount) : amount_(amount) {}

  double amount() const { return amount_; }
  // Per voxel of the grid, of kOne.
  std::span<const std::uint16_t> factors(const StoneGrid& grid);

 private:
  double amount_;
  std::vector<float> lattice_;
  std::vector<std::uint16_t> factors_;
};

}  // namespace talus::rocks
