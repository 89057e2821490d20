#include "talus/rocks/stone_grid.h"

#include <algorithm>
#include <array>

namespace talus::rocks {
namespace {

// A block along one axis: on which cube it lies and whether it takes interval B there.
struct Step {
  int cube;
  bool between;
};

// The blocks that a stone of cell `l` may reach: A at a corner cell and A B A at any other; the
// cube's own and those on either side along an axis that is not colored.
std::span<const Step> steps(const CellLayout& layout, int axis, int l) {
  static constexpr Step kAround[] = {{0, false}};
  static constexpr Step kBetween[] = {{0, false}, {0, true}, {1, false}};
  static constexpr Step kRepeating[] = {{-1, false}, {0, false}, {1, false}};
  if (!layout.colored[axis]) return kRepeating;
  return l == 0 ? std::span<const Step>(kAround) : kBetween;
}

// Candidates of the same cell as one of them; they follow each other, by seed.
int count_in_cell(std::span<const Candidate> candidates, std::size_t one) {
  const auto same = [&](const Candidate& c) { return c.cell == candidates[one].cell; };
  const auto first = candidates.begin() + static_cast<std::ptrdiff_t>(one - candidates[one].seed);
  return static_cast<int>(std::find_if_not(first, candidates.end(), same) - first);
}

}  // namespace

void StoneGrid::find_pieces(const BlockTable& blocks, const StoneKey& key) {
  const CellLayout& grid = blocks.layout();
  const CornerBox corners = grid.stone_corners(key.cell);
  std::array<int, 8> colors{};
  for (std::uint32_t i = 0, code = key.code; i < 8;
       ++i, code /= static_cast<std::uint32_t>(grid.colors))
    colors[i] = static_cast<int>(code % static_cast<std::uint32_t>(grid.colors));

  pieces_.clear();
  for (const Step& z : steps(grid, 2, key.cell.z))
    for (const Step& y : steps(grid, 1, key.cell.y))
      for (const Step& x : steps(grid, 0, key.cell.x)) {
        const BlockType type{{x.between, y.between, z.between}};
        const Int3 cube(x.cube, y.cube, z.cube);
        const std::uint32_t code = color_code(type.corners(), grid.colors, [&](const Int3& corner) {
          const Int3 at = grid.colored_corner(cube + corner);
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
  layout_ = &blocks.layout();
  cell_ = key.cell;

  VoxelBox extent;
  for (const Piece& piece : pieces_) {
    if (!piece.self) continue;
    form_ = piece.block->candidates[*piece.self].form;
    stones_in_cell_ = count_in_cell(piece.block->candidates, *piece.self);
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
    copy_own(piece);
    copy_beyond(piece);
  }
  return true;
}

// Runs are too short for copying in bulk to pay.
void StoneGrid::copy_own(const Piece& piece) {
  for (const VoxelRun& run : piece.block->runs_of(*piece.self)) {
    const std::size_t to = index(run.first + piece.offset);
    const float* const clearance = &piece.block->clearance[piece.block->index(run.first)];
    std::uint8_t* const own = &own_[to];
    float* const distance = &distance_[to];
    for (int k = 0; k < run.length; ++k) {
      own[k] = 1;
      distance[k] = clearance[k];
    }
    own_count_ += static_cast<std::size_t>(run.length);
  }
}

void StoneGrid::copy_beyond(const Piece& piece) {
  const BlockPatches& patches = piece.block->patches;
  for (const Patch& patch : patches.of(*piece.self)) {
    const float* from = &patches.distance_beyond[patch.first_face];
    for (const FaceRun& faces : patches.runs_of(patch)) {
      float* const to = &distance_[index(faces.beyond() + piece.offset)];
      for (int k = 0; k < faces.length; ++k) to[k] = *from++;
    }
  }
}

}  // namespace talus::rocks
