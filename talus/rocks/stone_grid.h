// One stone's voxels and their surroundings, put together from the blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/base/cube_root.h"
#include "talus/rocks/blocks.h"

namespace talus::rocks {

// Which stone of a tile set: a cell, the colors at `layout.stone_corners(cell)`, one of its seeds.
struct StoneKey {
  Int3 cell;
  std::uint32_t code;
  std::uint16_t seed;
};

// Voxels around a stone, one more on every side than it owns. Coordinates are in voxels relative to
// the corner of the stone's cell; voxel (x, y, z) is element x + size.x (y + size.y z) from `min()`
// on. Working memory is reused from stone to stone.
class StoneGrid {
 public:
  // A block within the stone's reach.
  struct Piece {
    const Block* block;
    Int3 offset;                        // stone voxel = block voxel + offset
    Int3 cells;                         // cell relative to the stone's = cell of the block + cells
    std::optional<std::uint32_t> self;  // the stone among the candidates
  };

  // Finds the stone's `pieces()` alone.
  void find_pieces(const BlockTable& blocks, const StoneKey& key);
  // Gathers the stone; false if it owns no voxel.
  bool gather(const BlockTable& blocks, const StoneKey& key);

  std::span<const Piece> pieces() const { return pieces_; }
  Int3 min() const { return min_; }
  Int3 size() const { return size_; }
  std::size_t count() const { return own_.size(); }
  std::size_t own_count() const { return own_count_; }
  std::size_t stride(int axis) const {
    return static_cast<std::size_t>(axis == 0 ? 1 : axis == 1 ? size_.x : size_.x * size_.y);
  }
  std::size_t index(const Int3& voxel) const {
    const Int3 at = voxel - min_;
    return static_cast<std::size_t>(at.x + size_.x * (at.y + size_.y * at.z));
  }
  Int3 voxel_at(std::size_t i) const {
    const int n = static_cast<int>(i);
    return min_ + Int3(n % size_.x, n / size_.x % size_.y, n / (size_.x * size_.y));
  }

  std::span<const std::uint8_t> own() const { return own_; }  // 1 for the stone's voxels, else 0
  Vec3f seed_position() const { return form_->position; }     // in voxels
  const CellLayout& layout() const { return *layout_; }
  Int3 cell() const { return cell_; }                     // the stone's, in its cube
  int stones_in_cell() const { return stones_in_cell_; }  // that grow from seeds of its cell
  // Edge of a cube as large as the mean stone of the stone's cell, in cells.
  double size_scale() const { return 1 / cube_root(stones_in_cell_); }

  // Signed distance in voxels, at most 1 in magnitude, to the surface between this stone and the
  // others: positive in its own voxels, negative across their faces, -1 elsewhere, and beyond the
  // blocks that the stone's colors determine. Where another stone has a value, too, the sum is at
  // most 0.
  std::span<const float> distances() const { return {distance_.data(), count()}; }

  // The owner's distance to others in a voxel of the grid that the stone's colors determine.
  float clearance(const Int3& voxel) const;

 private:
  void copy(const Piece& piece);
  void find_own();

  const Seed* form_ = nullptr;
  const CellLayout* layout_ = nullptr;
  Int3 cell_{0};
  int stones_in_cell_ = 0;
  std::vector<Piece> pieces_;
  Int3 min_{0};
  Int3 size_{0};
  std::size_t own_count_ = 0;
  std::vector<std::uint8_t> own_;
  std::vector<std::uint8_t> near_;  // 1 for own voxels and those across their faces
  std::vector<float> distance_;     // with room for kLanes more
};

}  // namespace talus::rocks
