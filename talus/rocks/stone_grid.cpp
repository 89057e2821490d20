#include "talus/rocks/stone_grid.h"

#include <algorithm>
#include <cmath>

namespace talus::rocks {
namespace {

constexpr int kTagBits = 16;  // low bits of a tag: the candidate; above them the piece

// Voxels whose owners are determined by the colors that a stone of `cell` depends on; both relative
// to one cube, whose lower corner is voxel 0.
VoxelBox known_voxels(const CellLayout& grid, const Int3& cell) {
  const Interval around_corner = interval(grid, false);
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const int cube = floor_div(cell[axis], grid.period());
    const bool at_corner = cell[axis] == cube * grid.period();
    const int first_corner = cube * grid.period_voxels();
    const int last_corner = at_corner ? first_corner : first_corner + grid.period_voxels();
    box.min[axis] = first_corner + around_corner.begin;
    box.max[axis] = last_corner + around_corner.end - 1;
  }
  return box;
}

float saturate(float x) { return std::clamp(x, -1.0f, 1.0f); }

}  // namespace

// Along an axis the blocks are A for a stone of a corner cell, and A B A for any other.
void StoneGrid::find_pieces(const StoneKey& key) {
  const CellLayout& grid = blocks_->layout();
  const CornerBox corners = grid.stone_corners(key.cell);
  const Int3 steps = 2 * corners.count - 1;
  pieces_.clear();
  for (int z = 0; z < steps.z; ++z)
    for (int y = 0; y < steps.y; ++y)
      for (int x = 0; x < steps.x; ++x) {
        const BlockType type{{x == 1, y == 1, z == 1}};
        const Int3 cube(x == 2, y == 2, z == 2);
        const std::uint32_t code = color_code(type.corners(), grid.colors, [&](const Int3& corner) {
          return decode_color(corners, grid.colors, key.code, cube + corner);
        });
        const Block& block = blocks_->block(type, code);
        pieces_.push_back({&block, cube, block.find(key.cell - grid.period() * cube, key.seed)});
      }
}

Int3 StoneGrid::offset_of(const Piece& piece) const {
  const CellLayout& grid = blocks_->layout();
  return grid.period_voxels() * piece.cube - grid.voxels_per_cell * cell_;
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
    if (!part.empty()) extent.include(part.moved(offset_of(piece)));
  }
  if (extent.empty()) return false;

  min_ = extent.min - 1;
  size_ = extent.max - extent.min + 3;
  const std::size_t count = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                            static_cast<std::size_t>(size_.z);
  owner_.assign(count, kUnknown);
  nearest_.resize(count);
  second_.resize(count);
  for (std::size_t i = 0; i < pieces_.size(); ++i) copy_piece(i);

  own_.clear();
  std::size_t i = 0;
  for (int z = 0; z < size_.z; ++z)
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x, ++i)
        if (owner_[i] == kOwn) own_.push_back({min_ + Int3(x, y, z), i});
  return true;
}

void StoneGrid::copy_piece(std::size_t index) {
  const Piece& piece = pieces_[index];
  const Block& block = *piece.block;
  const Int3 offset = offset_of(piece);
  const Int3 begin = glm::max(min_, block.min + offset);
  const Int3 end = glm::min(min_ + size_, block.min + block.size + offset);
  const auto tag = static_cast<std::int32_t>(index << kTagBits) + 1;
  const int self = piece.self ? *piece.self : -1;
  for (int z = begin.z; z < end.z; ++z)
    for (int y = begin.y; y < end.y; ++y) {
      const Int3 row(begin.x, y, z);
      std::size_t from = block.index(row - offset);
      const Int3 at = row - min_;
      auto to = static_cast<std::size_t>(at.x + size_.x * (at.y + size_.y * at.z));
      for (int x = begin.x; x < end.x; ++x, ++from, ++to) {
        const int owner = block.owner[from];
        owner_[to] = owner == self ? kOwn : tag + owner;
        nearest_[to] = block.nearest[from];
        second_[to] = block.second[from];
      }
    }
}

Neighbor StoneGrid::neighbor(std::int32_t tag) const {
  const CellLayout& grid = blocks_->layout();
  const auto piece_index = static_cast<std::size_t>((tag - 1) >> kTagBits);
  const auto candidate_index = static_cast<std::size_t>((tag - 1) & ((1 << kTagBits) - 1));
  const Piece& piece = pieces_[piece_index];
  const Candidate& candidate = piece.block->candidates[candidate_index];
  const Int3 cell = candidate.cell + grid.period() * piece.cube;
  return {.cell = cell - cell_,
          .seed = candidate.seed,
          .known = known_voxels(grid, cell).moved(-grid.voxels_per_cell * cell_)};
}

float StoneGrid::distance(std::size_t i) const {
  if (owner_[i] == kOwn) return saturate(0.5f * (second_[i] - nearest_[i]));
  if (owner_[i] == kUnknown) return -1;
  const Int3 voxel = voxel_at(i);
  const float penalty =
      std::max({blocks_->penalty(cell_.x, voxel.x), blocks_->penalty(cell_.y, voxel.y),
                blocks_->penalty(cell_.z, voxel.z)});
  const Vec3f center = Vec3f(voxel) + 0.5f;
  const float own = std::sqrt(form_->distance(center.x, center.y, center.z) * penalty);
  return saturate(0.5f * (nearest_[i] - own));
}

}  // namespace talus::rocks
