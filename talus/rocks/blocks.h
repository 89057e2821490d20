// Who owns each voxel, for every block that a tiling can contain.
//
// Along each axis space falls into intervals A (around a cube corner) and B (between two). A block
// is a product of three of them; its content depends on the colors of the corners it touches, so a
// few hundred blocks make up every tiling. See docs/rocks.md.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "talus/rocks/seeds.h"

namespace talus::rocks {

// A seed that competes for a block's voxels.
struct Candidate {
  Int3 cell;  // relative to the cube whose lower corner is the block's first corner
  std::uint16_t seed;
  const Seed* form;
};

// Box of voxels, `max` included; empty if min.x > max.x.
struct VoxelBox {
  Int3 min{std::numeric_limits<int>::max()};
  Int3 max{std::numeric_limits<int>::min()};

  bool empty() const { return min.x > max.x; }
  void include(const VoxelBox& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  VoxelBox moved(const Int3& offset) const { return {min + offset, max + offset}; }
};

// Voxel (x, y, z) of a block is element x + size.x (y + size.y z). Distances are sqrt(D) in voxels.
struct Block {
  Int3 min;  // first voxel, relative to the cube's lower corner
  Int3 size;
  std::vector<Candidate> candidates;  // sorted by cell (z, y, x), then seed
  std::vector<VoxelBox> extent;       // per candidate, around the voxels it owns
  std::vector<std::uint16_t> owner;   // index of the candidate with the least D
  std::vector<float> nearest;         // its distance
  std::vector<float> second;          // the least distance among the others

  std::size_t index(const Int3& voxel) const {
    const Int3 at = voxel - min;
    return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
  }
  // Index of a candidate, or nothing if that seed does not compete here.
  std::optional<std::uint16_t> find(const Int3& cell, std::uint16_t seed) const;
};

// Which interval a block takes along each axis.
struct BlockType {
  bool between[3];  // B if true, A otherwise

  CornerBox corners() const {
    return {.first = Int3(0), .count = {1 + between[0], 1 + between[1], 1 + between[2]}};
  }
};

class BlockTable {
 public:
  // Labels all blocks, in parallel.
  BlockTable(const TileParams& params, std::uint64_t seed, Job* job);

  // `code` numbers the colors at `type.corners()`.
  const Block& block(const BlockType& type, std::uint32_t code) const {
    return blocks_[first_block_[type_index(type)] + code];
  }
  const SeedTable& seeds() const { return seeds_; }
  const CellLayout& layout() const { return seeds_.layout(); }

  // 1 / phi along one axis for a stone of cell `l`, at a voxel relative to its cell: 1 where the
  // stone is free, growing to infinity where its reach ends.
  float penalty(int l, int voxel) const {
    const std::vector<float>& row = penalty_[static_cast<std::size_t>(l)];
    const int i = voxel + penalty_offset_;
    return i < 0 || i >= static_cast<int>(row.size()) ? std::numeric_limits<float>::infinity()
                                                      : row[static_cast<std::size_t>(i)];
  }

 private:
  static std::size_t type_index(const BlockType& t) {
    return static_cast<std::size_t>(t.between[0] + 2 * t.between[1] + 4 * t.between[2]);
  }
  void make_penalties();
  Block make_block(const BlockType& type, std::uint32_t code) const;
  void label(Block& block) const;

  SeedTable seeds_;
  std::vector<std::vector<float>> penalty_;  // per cell index along an axis
  int penalty_offset_ = 0;
  std::vector<Block> blocks_;
  std::size_t first_block_[8] = {};
};

// First voxel of interval A or B at a cube, and its length, relative to the cube's lower corner.
struct Interval {
  int begin;
  int end;
};
inline Interval interval(const CellLayout& layout, bool between) {
  const int margin = layout.margin_voxels(), v = layout.voxels_per_cell;
  return between ? Interval{v + margin, layout.period_voxels() - margin}
                 : Interval{-margin, v + margin};
}

}  // namespace talus::rocks
