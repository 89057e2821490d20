#include "talus/rocks/stone_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace talus::rocks {

// Along an axis the blocks are A for a stone of a corner cell, and A B A for any other.
void StoneGrid::find_pieces(const StoneKey& key) {
  const CellLayout& grid = blocks_->layout();
  const CornerBox corners = grid.stone_corners(key.cell);
  std::array<int, 8> colors{};
  for (std::uint32_t i = 0, code = key.code; i < 8;
       ++i, code /= static_cast<std::uint32_t>(grid.colors))
    colors[i] = static_cast<int>(code % static_cast<std::uint32_t>(grid.colors));

  steps_ = 2 * corners.count - 1;
  pieces_.clear();
  for (int z = 0; z < steps_.z; ++z)
    for (int y = 0; y < steps_.y; ++y)
      for (int x = 0; x < steps_.x; ++x) {
        const BlockType type{{x == 1, y == 1, z == 1}};
        const Int3 cube(x == 2, y == 2, z == 2);
        const std::uint32_t code = color_code(type.corners(), grid.colors, [&](const Int3& corner) {
          const Int3 at = cube + corner;
          return colors[static_cast<std::size_t>(at.x + corners.count.x *
                                                            (at.y + corners.count.y * at.z))];
        });
        const Block& block = blocks_->block(type, code);
        const Int3 cells = grid.period() * cube - key.cell;
        pieces_.push_back({.block = &block,
                           .offset = grid.voxels_per_cell * cells,
                           .cells = cells,
                           .self = block.find(-cells, key.seed)});
      }
}

bool StoneGrid::gather(const BlockTable& blocks, const StoneKey& key) {
  blocks_ = &blocks;
  cell_ = key.cell;
  find_pieces(key);

  VoxelBox extent;
  for (const Piece& piece : pieces_) {
    if (!piece.self) continue;
    form_ = piece.block->candidates[*piece.self].form;
    const VoxelBox& part = piece.block->extent[*piece.self];
    if (!part.empty()) extent.include(part.moved(piece.offset));
  }
  if (extent.empty()) return false;

  min_ = extent.min - 1;
  size_ = extent.max - extent.min + 3;
  const std::size_t count = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                            static_cast<std::size_t>(size_.z);
  own_.assign(count, 0);
  clearance_.assign(count, -1.0f);
  own_count_ = 0;
  for (const Piece& piece : pieces_) {
    if (!piece.self) continue;
    for (const VoxelRun& run : piece.block->runs_of(*piece.self)) {
      const auto to = static_cast<std::ptrdiff_t>(index(run.first + piece.offset));
      std::fill_n(own_.begin() + to, run.length, std::uint8_t{1});
      std::copy_n(&piece.block->clearance[piece.block->index(run.first)], run.length,
                  clearance_.begin() + to);
      own_count_ += static_cast<std::size_t>(run.length);
    }
  }
  return true;
}

const StoneGrid::Piece* StoneGrid::piece_at(const Int3& voxel) const {
  std::size_t index = 0, stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto steps = static_cast<std::size_t>(steps_[axis]);
    for (std::size_t step = 0;; ++step) {
      if (step == steps) return nullptr;
      const Piece& piece = pieces_[step * stride];
      const int begin = piece.block->min[axis] + piece.offset[axis];
      if (voxel[axis] < begin) return nullptr;
      if (voxel[axis] >= begin + piece.block->size[axis]) continue;
      index += step * stride;
      break;
    }
    stride *= steps;
  }
  return &pieces_[index];
}

float StoneGrid::distance_outside(const Int3& voxel) const {
  const Piece* const piece = piece_at(voxel);
  if (!piece) return -1;
  const float penalty =
      std::max({blocks_->penalty(cell_.x, voxel.x), blocks_->penalty(cell_.y, voxel.y),
                blocks_->penalty(cell_.z, voxel.z)});
  const Vec3f center = Vec3f(voxel) + 0.5f;
  const float own = std::sqrt(form_->distance(center.x, center.y, center.z) * penalty);
  return std::max(0.5f * (piece->block->nearest[piece->block->index(voxel - piece->offset)] - own),
                  -1.0f);
}

}  // namespace talus::rocks
