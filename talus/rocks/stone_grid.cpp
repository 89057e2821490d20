#include "talus/rocks/stone_grid.h"

#include <algorithm>
#include <array>

namespace talus::rocks {

// Along an axis the blocks are A for a stone of a corner cell, and A B A for any other.
void StoneGrid::find_pieces(const BlockTable& blocks, const StoneKey& key) {
  const CellLayout& grid = blocks.layout();
  const CornerBox corners = grid.stone_corners(key.cell);
  std::array<int, 8> colors{};
  for (std::uint32_t i = 0, code = key.code; i < 8;
       ++i, code /= static_cast<std::uint32_t>(grid.colors))
    colors[i] = static_cast<int>(code % static_cast<std::uint32_t>(grid.colors));

  const Int3 steps = 2 * corners.count - 1;
  pieces_.clear();
  for (int z = 0; z < steps.z; ++z)
    for (int y = 0; y < steps.y; ++y)
      for (int x = 0; x < steps.x; ++x) {
        const BlockType type{{x == 1, y == 1, z == 1}};
        const Int3 cube(x == 2, y == 2, z == 2);
        const std::uint32_t code = color_code(type.corners(), grid.colors, [&](const Int3& corner) {
          const Int3 at = cube + corner;
          return colors[static_cast<std::size_t>(at.x + corners.count.x *
                                                            (at.y + corners.count.y * at.z))];
        });
        const Block& block = blocks.block(type, code);
        const Int3 cells = grid.period() * cube - key.cell;
        pieces_.push_back({.block = &block,
                           .offset = grid.voxels_per_cell * cells,
                           .cells = cells,
                           .self = block.find(-cells, key.seed)});
      }
}

bool StoneGrid::gather(const BlockTable& blocks, const StoneKey& key) {
  find_pieces(blocks, key);

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
  distance_.assign(count, -1.0f);
  own_count_ = 0;
  for (const Piece& piece : pieces_) {
    if (!piece.self) continue;
    for (const VoxelRun& run : piece.block->runs_of(*piece.self)) {
      const auto to = static_cast<std::ptrdiff_t>(index(run.first + piece.offset));
      std::fill_n(own_.begin() + to, run.length, std::uint8_t{1});
      std::copy_n(&piece.block->clearance[piece.block->index(run.first)], run.length,
                  distance_.begin() + to);
      own_count_ += static_cast<std::size_t>(run.length);
    }
    const BlockPatches& patches = piece.block->patches;
    for (const Patch& patch : patches.of(*piece.self)) {
      const float* from = &patches.distance_beyond[patch.first_face];
      for (const FaceRun& faces : patches.runs_of(patch)) {
        Int3 beyond = faces.voxel() + piece.offset;
        beyond[faces.axis] += faces.side();
        float* const to = &distance_[index(beyond)];
        for (int k = 0; k < faces.length; ++k) to[k] = *from++;
      }
    }
  }
  return true;
}

}  // namespace talus::rocks
