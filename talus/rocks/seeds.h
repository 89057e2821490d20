// Seed points and the distance each measures.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "talus/rocks/colors.h"

namespace talus::rocks {

// A seed in its cell. The distance to it is a quadratic form in voxels around `position` (voxels
// from the cell's lower corner).
struct Seed {
  Vec3f position;
  float xx, yy, zz, xy, xz, yz;
  float growth;  // distance() is at least this times the squared Euclidean distance

  // d = f / g of [Peytavie2009] section 4 in squared voxels, for an offset from the cell's corner
  // in voxels; x may be several side by side. Depends on the offset alone, so a stone is the same
  // wherever its cell is placed.
  template <class X>
  X distance(X x, float y, float z) const {
    const X dx = x - position.x;
    const float dy = y - position.y, dz = z - position.z;
    return (xx * dx + (xy * dy + xz * dz)) * dx + ((yy * dy + yz * dz) * dy + zz * (dz * dz));
  }
  // The root of distance() changes by at most this from a point to one a voxel away. The
  // coefficients sum up to the squares of three such numbers, for the three axes of the form.
  float steepness() const { return std::sqrt(xx + yy + zz - 2 * growth); }
};

// The seeds of every cell for all colors it depends on, made by hash of (cell, colors).
class SeedTable {
 public:
  SeedTable(const TileParams& params, std::uint64_t seed);

  // `code` numbers the colors at `layout.seed_corners(cell)`.
  std::span<const Seed> seeds(const Int3& cell, std::uint32_t code) const {
    const std::size_t key = cell_keys_[layout_.cell_index(cell)] + code;
    return {seeds_.data() + first_[key], first_[key + 1] - first_[key]};
  }
  const CellLayout& layout() const { return layout_; }

 private:
  CellLayout layout_;
  std::vector<Seed> seeds_;
  std::vector<std::size_t> first_;      // per key, one past the end last
  std::vector<std::size_t> cell_keys_;  // per cell, its first key
};

}  // namespace talus::rocks
