// Who owns each voxel, for every block that a tiling can contain.
//
// Along an axis with colored corners space falls into intervals A (around a corner) and B (between
// two); along any other there is one interval, the cube's. A block is a product of three of them;
// its content depends on the colors of the corners it touches, so a few hundred blocks make up
// every tiling. See docs/rocks.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "talus/rocks/patches.h"
#include "talus/rocks/seeds.h"

namespace talus::rocks {

// A seed that competes for a block's voxels.
struct Candidate {
  Int3 cell;  // relative to the cube whose lower corner is the block's first corner
  std::uint16_t seed;
  const Seed* form;
  // By axis: what voxel i of the block's cube, also one next to the block, looks up at [i].
  std::array<const float*, 3> centers;    // its coordinate, relative to the cell
  std::array<const float*, 3> penalties;  // 1 / phi along the axis
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

// Differs between stones that take different voxels or faces from a block, but for one in 2^64.
using StonePrint = std::array<std::uint64_t, 2>;

// Voxel (x, y, z) is element x + size.x (y + size.y z).
struct Block {
  Int3 min;  // first voxel, relative to the cube's lower corner
  Int3 size;
  Int3 first_cell;  // of the box of cells whose seeds compete
  Int3 cells;
  std::vector<Candidate> candidates;      // sorted by cell (z, y, x), then seed
  std::vector<std::uint32_t> cell_first;  // per cell its first candidate; their number last

  // Per voxel the candidates with the least D and the second least, and half of the difference
  // between their sqrt(D), in voxels, at most 1; at 1 the runner-up is not certain. All three go on
  // for kLanes elements that mean nothing.
  std::vector<std::uint32_t> owners, runners_up;
  std::vector<float> clearance;
  std::vector<VoxelBox> extent;    // per candidate, around the voxels it owns
  BlockPatches patches;            // where stones meet
  std::vector<StonePrint> prints;  // per candidate

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  std::size_t index(const Int3& voxel) const {
    const Int3 at = voxel - min;
    return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
  }
  // Calls `use(first, length, owner)` for every longest run of voxels of one owner along x, in
  // order.
  void for_each_run(auto&& use) const {
    const std::uint32_t* row = owners.data();
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y, row += size.x)
        for (int x = 0; x < size.x;) {
          const int begin = x;
          while (x < size.x && row[x] == row[begin]) ++x;
          use(min + Int3(begin, y, z), x - begin, row[begin]);
        }
  }
  // The candidates of a cell, none if it does not compete here.
  std::span<const Candidate> candidates_of(const Int3& cell) const;
  // Index of a candidate, or nothing if that seed does not compete here.
  std::optional<std::uint32_t> find(const Int3& cell, std::uint16_t seed) const;
};

// Which interval a block takes along each axis.
struct BlockType {
  bool between[3];  // B if true, otherwise A or, where there are no others, the cube's

  CornerBox corners() const {
    return {.first = Int3(0), .count = {1 + between[0], 1 + between[1], 1 + between[2]}};
  }
};

// A block of a table: its colors are numbered `code` at `type.corners()`.
struct BlockPlace {
  BlockType type;
  std::uint32_t code;
};

struct AdjacentBlock;

class BlockTable {
 public:
  // Labels all blocks and finds where stones meet in them, in parallel.
  BlockTable(const TileParams& params, std::uint64_t seed, Job* job);

  // `code` numbers the colors at `type.corners()`.
  const Block& block(const BlockType& type, std::uint32_t code) const {
    return blocks_[first_block_[type_index(type)] + code];
  }
  std::span<const Block> blocks() const { return blocks_; }
  std::size_t index_of(const Block& block) const {
    return static_cast<std::size_t>(&block - blocks_.data());
  }
  std::span<const BlockPlace> places() const { return places_; }  // of the blocks
  // The blocks around corners on either side of an interval between them, and the next cube's along
  // an axis where all cubes are the same.
  std::vector<AdjacentBlock> adjacent(const BlockPlace& place) const;

  const SeedTable& seeds() const { return seeds_; }
  const CellLayout& layout() const { return seeds_.layout(); }

 private:
  static std::size_t type_index(const BlockType& t) {
    return static_cast<std::size_t>(t.between[0] + 2 * t.between[1] + 4 * t.between[2]);
  }
  void make_penalties();
  // The penalties along an axis for a cell of index `l` in its cube.
  const std::vector<float>& penalties(int axis, int l) const {
    return penalties_[static_cast<std::size_t>(layout().colored[axis] ? l : layout().period())];
  }
  Block make_block(const BlockPlace& place) const;
  void compare_stones(std::size_t index);

  SeedTable seeds_;
  // At voxel i - `penalty_offset_` relative to a cell: its center, and the penalty for each index
  // that the cell can have along a colored axis of its cube; last, that along any other axis.
  std::vector<float> centers_;
  std::vector<std::vector<float>> penalties_;
  int penalty_offset_ = 0;
  std::vector<Block> blocks_;
  std::vector<BlockPlace> places_;
  std::size_t first_block_[8] = {};
};

// Voxels `begin` to `end`, the end excluded, relative to a cube's lower corner: those that a block
// at the cube covers along an axis.
struct Interval {
  int begin;
  int end;
};
inline Interval interval(const CellLayout& layout, int axis, bool between) {
  if (!layout.colored[axis]) return {0, layout.period_voxels()};
  const int margin = layout.margin_voxels(), v = layout.voxels_per_cell;
  return between ? Interval{v + margin, layout.period_voxels() - margin}
                 : Interval{-margin, v + margin};
}

}  // namespace talus::rocks
