// One stone's voxels and their surroundings, cut out of the blocks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/rocks/blocks.h"

namespace talus::rocks {

// Which stone of a tile set: a cell, the colors at `layout.stone_corners(cell)`, one of its seeds.
struct StoneKey {
  Int3 cell;
  std::uint32_t code;
  std::uint16_t seed;
};

// A stone next to the one at hand.
struct Neighbor {
  Int3 cell;  // in cells relative to the stone's
  std::uint16_t seed;
  VoxelBox known;  // voxels whose owners its colors determine, relative to the stone's cell

  bool operator==(const Neighbor& o) const { return cell == o.cell && seed == o.seed; }
};

// Index of a voxel some strides away.
inline std::size_t moved(std::size_t i, std::ptrdiff_t step) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + step);
}

// A voxel of a stone: where it is, and its index in the grid.
struct OwnVoxel {
  Int3 at;
  std::size_t index;
};

// Voxels around a stone, one more on every side than it owns. Coordinates are in voxels relative to
// the corner of the stone's cell. Working memory is reused from stone to stone.
class StoneGrid {
 public:
  static constexpr std::int32_t kUnknown = -1;  // beyond the blocks that the stone determines
  static constexpr std::int32_t kOwn = 0;       // larger values are tags of other stones

  // Gathers the stone; false if it owns no voxel.
  bool gather(const BlockTable& blocks, const StoneKey& key);

  Int3 min() const { return min_; }
  Int3 size() const { return size_; }
  std::size_t count() const { return owner_.size(); }
  std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size_.x : std::ptrdiff_t{size_.x} * size_.y;
  }
  Int3 voxel_at(std::size_t i) const {
    const int n = static_cast<int>(i);
    return min_ + Int3(n % size_.x, n / size_.x % size_.y, n / (size_.x * size_.y));
  }

  bool own(std::size_t i) const { return owner_[i] == kOwn; }
  std::int32_t owner(std::size_t i) const { return owner_[i]; }
  std::span<const OwnVoxel> own_voxels() const { return own_; }  // by increasing index
  // The stone behind a tag. Two tags may name one stone.
  Neighbor neighbor(std::int32_t tag) const;

  Vec3f seed_position() const { return form_->position; }  // in voxels

  // Signed distance in voxels, at most 1 in magnitude, to the surface between this stone and the
  // others: positive in own voxels only, and of opposite sign and no larger for every other stone.
  float distance(std::size_t i) const;

 private:
  // A block within the stone's reach, and where its cube lies relative to the stone's.
  struct Piece {
    const Block* block;
    Int3 cube;
    std::optional<std::uint16_t> self;
  };
  void find_pieces(const StoneKey& key);
  Int3 offset_of(const Piece& piece) const;  // stone voxel = block voxel + offset
  void copy_piece(std::size_t index);

  const BlockTable* blocks_ = nullptr;
  Int3 cell_{0};
  const Seed* form_ = nullptr;
  std::vector<Piece> pieces_;
  Int3 min_{0};
  Int3 size_{0};
  std::vector<std::int32_t> owner_;
  std::vector<float> nearest_;
  std::vector<float> second_;
  std::vector<OwnVoxel> own_;
};

}  // namespace talus::rocks
