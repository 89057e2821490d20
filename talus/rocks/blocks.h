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

// Voxels of one owner next to each other in a row, from x = begin to end - 1.
struct RowRun {
  int begin, end;
  std::uint32_t owner;
};

// Voxels of one stone next to each other along x.
struct VoxelRun {
  Int3 first;
  int length;
};

// Voxel (x, y, z) is element x + size.x (y + size.y z). Distances are sqrt(D) in voxels.
struct Block {
  Int3 min;  // first voxel, relative to the cube's lower corner
  Int3 size;
  Int3 first_cell;  // of the box of cells whose seeds compete
  Int3 cells;
  std::vector<Candidate> candidates;      // sorted by cell (z, y, x), then seed
  std::vector<std::uint32_t> cell_first;  // per cell its first candidate; their number last

  std::vector<float> nearest;            // the least distance; dropped once patches are found
  std::vector<float> clearance;          // half of what the next one is farther, at most 1
  std::vector<RowRun> rows;              // owners: the candidates with the least D
  std::vector<std::uint32_t> row_first;  // per row its first run; their number last

  std::vector<VoxelRun> runs;            // the same runs, by owner
  std::vector<std::uint32_t> run_first;  // per candidate its first run; their number last
  std::vector<VoxelBox> extent;          // per candidate, around the voxels it owns
  BlockPatches patches;                  // where they meet others

  std::size_t index(const Int3& voxel) const {
    const Int3 at = voxel - min;
    return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
  }
  std::span<const RowRun> row(int y, int z) const {
    const auto r = static_cast<std::size_t>(y - min.y + size.y * (z - min.z));
    return std::span(rows).subspan(row_first[r], row_first[r + 1] - row_first[r]);
  }
  std::span<const VoxelRun> runs_of(std::size_t candidate) const {
    return std::span(runs).subspan(run_first[candidate],
                                   run_first[candidate + 1] - run_first[candidate]);
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

class BlockTable {
 public:
  // Labels all blocks and finds where stones meet in them, in parallel.
  BlockTable(const TileParams& params, std::uint64_t seed, Job* job);

  // `code` numbers the colors at `type.corners()`.
  const Block& block(const BlockType& type, std::uint32_t code) const {
    return blocks_[first_block_[type_index(type)] + code];
  }
  std::span<const Block> blocks() const { return blocks_; }
  std::span<const BlockPlace> places() const { return places_; }  // of the blocks

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
  BlockPatches patches(const BlockPlace& place) const;

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
