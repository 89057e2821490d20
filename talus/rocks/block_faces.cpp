#include "talus/rocks/block_faces.h"

namespace talus::rocks {
namespace {

// Whether the colors that a stone of `cell` depends on determine a block at the cube at the origin.
bool knows(const Int3& cell, const BlockType& type, const CellLayout& layout) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!layout.colored[axis]) continue;
    const int cube = floor_div(cell[axis], layout.period());
    const bool at_corner = cell[axis] == cube * layout.period();
    const bool after_last = cube == -1 && !at_corner && !type.between[axis];
    const bool in_own_cube = cube == 0 && !(at_corner && type.between[axis]);
    if (!after_last && !in_own_cube) return false;
  }
  return true;
}

}  // namespace

BlockFaces::BlockFaces(const Block& block, const BlockType& type,
                       std::span<const AdjacentBlock> adjacent, const CellLayout& layout)
    : block_(block), layout_(layout), differing_(static_cast<std::size_t>(block.size.x)) {
  owners_across_.resize(static_cast<std::size_t>(block.size.x));
  runners_up_across_.resize(static_cast<std::size_t>(block.size.x));
  for (const Candidate& c : block.candidates) parties_.push_back({c.cell, c.seed});
  for (const AdjacentBlock& next : adjacent) {
    Neighbor& neighbor = neighbors_.emplace_back(next);
    for (const Candidate& c : next.block->candidates) {
      const Int3 cell = c.cell + layout.period() * next.cube;
      const auto own = block.find(cell, c.seed);
      neighbor.party_of.push_back(own ? *own : static_cast<std::uint32_t>(parties_.size()));
      if (!own) parties_.push_back({cell, c.seed});
    }
  }
  for (const Party& party : parties_) known_.push_back(knows(party.cell, type, layout));
}

}  // namespace talus::rocks
