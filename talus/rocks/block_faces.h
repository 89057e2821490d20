// The voxel faces where stones of a block meet each other and those of adjacent blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/rocks/blocks.h"

namespace talus::rocks {

// A block next to another along an axis, on a cube that lies `cube` from the other's.
struct AdjacentBlock {
  const Block* block;
  int axis;
  Int3 cube;
};

// A face between voxels of two parties.
struct Face {
  std::uint32_t lower, upper;                      // parties that own the voxels
  std::uint32_t lower_runner_up, upper_runner_up;  // parties
  float lower_clearance, upper_clearance;
  Int3 voxel;  // the lower one, relative to the block's cube
  int axis;
  bool shared;  // both parties' colors determine the block

  Int3 voxel_above() const {
    Int3 above = voxel;
    ++above[axis];
    return above;
  }
  // In half voxels.
  Int3 middle() const { return voxel + voxel_above() + 1; }
};

// Every face of a tiling belongs to one block: that of the voxel whose owner depends on more
// corners, the lower one of equals.
class BlockFaces {
 public:
  BlockFaces(const Block& block, const BlockType& type, std::span<const AdjacentBlock> adjacent,
             const CellLayout& layout);

  // The block's candidates first, then others that adjacent blocks hold.
  std::span<const Party> parties() const { return parties_; }

  // Calls `use(face)` for every face.
  void for_each(auto&& use);

 private:
  struct Row {
    const std::uint32_t *parties, *runners_up;
    const float* clearance;

    Row next() const { return {parties + 1, runners_up + 1, clearance + 1}; }
  };
  struct Neighbor {
    AdjacentBlock block;
    std::vector<std::uint32_t> party_of;  // its candidates
  };

  Row row(const Int3& first) const {
    const std::size_t i = block_.index(first);
    return {&block_.owners[i], &block_.runners_up[i], &block_.clearance[i]};
  }
  void within(auto&& use);
  void across(const Neighbor& neighbor, auto&& use);
  // The faces between `count` voxels from `first` on and those above them along an axis.
  void compare(const Row& lower, const Row& upper, int count, const Int3& first, int axis,
               auto&& use);

  const Block& block_;
  const CellLayout& layout_;
  std::vector<Party> parties_;
  std::vector<std::uint8_t> known_;  // by party: whether its colors determine the block
  std::vector<Neighbor> neighbors_;
  std::vector<int> differing_;                                    // places along a row
  std::vector<std::uint32_t> owners_across_, runners_up_across_;  // of a row: parties
};

void BlockFaces::compare(const Row& lower, const Row& upper, int count, const Int3& first, int axis,
                         auto&& use) {
  int found = 0;
  for (int x = 0; x < count; ++x) {
    differing_[static_cast<std::size_t>(found)] = x;
    found += lower.parties[x] != upper.parties[x];
  }
  for (int k = 0; k < found; ++k) {
    const int x = differing_[static_cast<std::size_t>(k)];
    use(Face{.lower = lower.parties[x],
             .upper = upper.parties[x],
             .lower_runner_up = lower.runners_up[x],
             .upper_runner_up = upper.runners_up[x],
             .lower_clearance = lower.clearance[x],
             .upper_clearance = upper.clearance[x],
             .voxel = first + Int3(x, 0, 0),
             .axis = axis,
             .shared = (known_[lower.parties[x]] & known_[upper.parties[x]]) != 0});
  }
}

void BlockFaces::within(auto&& use) {
  const Int3 end = block_.min + block_.size;
  for (int z = block_.min.z; z < end.z; ++z)
    for (int y = block_.min.y; y < end.y; ++y) {
      const Int3 first(block_.min.x, y, z);
      const Row here = row(first);
      compare(here, here.next(), block_.size.x - 1, first, 0, use);
      if (y + 1 < end.y) compare(here, row(first + Int3(0, 1, 0)), block_.size.x, first, 1, use);
      if (z + 1 < end.z) compare(here, row(first + Int3(0, 0, 1)), block_.size.x, first, 2, use);
    }
}

void BlockFaces::across(const Neighbor& neighbor, auto&& use) {
  const auto& [block, axis, cube] = neighbor.block;
  const bool above = cube[axis] > 0;
  // The layer of voxels at the plane between the blocks.
  Int3 begin = block_.min, end = block_.min + block_.size;
  begin[axis] = above ? end[axis] - 1 : begin[axis];
  end[axis] = begin[axis] + 1;
  const int count = end.x - begin.x;
  for (int z = begin.z; z < end.z; ++z)
    for (int y = begin.y; y < end.y; ++y) {
      const Int3 own(begin.x, y, z);
      Int3 other = own;
      other[axis] += above ? 1 : -1;
      const std::size_t i = block->index(other - layout_.period_voxels() * cube);
      for (std::size_t x = 0; x < static_cast<std::size_t>(count); ++x) {
        owners_across_[x] = neighbor.party_of[block->owners[i + x]];
        runners_up_across_[x] = neighbor.party_of[block->runners_up[i + x]];
      }
      const Row here = row(own);
      const Row there{owners_across_.data(), runners_up_across_.data(), &block->clearance[i]};
      compare(above ? here : there, above ? there : here, count, above ? own : other, axis, use);
    }
}

void BlockFaces::for_each(auto&& use) {
  within(use);
  for (const Neighbor& neighbor : neighbors_) across(neighbor, use);
}

}  // namespace talus::rocks
