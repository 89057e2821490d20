#include "talus/rocks/stone_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "talus/base/error.h"
#include "talus/base/lanes.h"

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

// How much farther a stone counts in another's voxel if a third one is nearer. Where three meet
// their meshes would else go into each other within a cell of marching cubes.
constexpr float kThirdBetween = 0.4f;

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
  own_.resize(count);
  near_.resize(count);
  distance_.assign(count + kLanes, -1.0f);
  for (const Piece& piece : pieces_)
    if (piece.self) copy(piece);
  find_own();
  return true;
}

// Distances in others' voxels are kept across the stone's faces only.
void StoneGrid::find_own() {
  const std::size_t count = own_.size(), dy = stride(1), dz = stride(2);
  std::uint8_t *const own = own_.data(), *const near = near_.data();
  float* const distance = distance_.data();
  std::uint32_t own_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t positive = ~std::bit_cast<std::uint32_t>(distance[i]) >> 31;
    own[i] = static_cast<std::uint8_t>(positive);
    own_count += positive;
  }
  own_count_ = own_count;

  // None are in the first layer or the last.
  std::copy(own + dz, own + 2 * dz, near);
  for (std::size_t i = dz; i < count - dz; ++i)
    near[i] =
        own[i] | own[i - 1] | own[i + 1] | own[i - dy] | own[i + dy] | own[i - dz] | own[i + dz];
  std::copy(own + count - 2 * dz, own + count - dz, near + count - dz);
  for (std::size_t i = 0; i < count; ++i)
    distance[i] = std::min(distance[i], 2 * static_cast<float>(near[i]) - 1);
}

float StoneGrid::clearance(const Int3& voxel) const {
  const auto holds = [&](const Piece& piece) {
    const Int3 at = voxel - piece.offset - piece.block->min;
    return glm::all(glm::greaterThanEqual(at, Int3(0))) &&
           glm::all(glm::lessThan(at, piece.block->size));
  };
  const auto piece = std::find_if(pieces_.begin(), pieces_.end(), holds);
  TALUS_ASSERT(piece != pieces_.end());
  return piece->block->clearance[piece->block->index(voxel - piece->offset)];
}

void StoneGrid::copy(const Piece& piece) {
  const Block& block = *piece.block;
  const Int3 begin = glm::max(min_, block.min + piece.offset);
  const Int3 end = glm::min(min_ + size_, block.min + block.size + piece.offset);
  if (glm::any(glm::lessThanEqual(end, begin))) return;
  const int count = end.x - begin.x;
  const Indices self = Indices{} + static_cast<std::int32_t>(*piece.self);
  const std::uint32_t* const owners = block.owners.data();
  const std::uint32_t* const runners_up = block.runners_up.data();
  const float* const clearances = block.clearance.data();
  const auto distance = [=](std::size_t i) {
    const Indices own = load<Indices>(owners + i) == self;
    const Indices next = load<Indices>(runners_up + i) == self;
    const Floats clearance = load<Floats>(clearances + i);
    const Floats other = next ? -clearance : -clearance - kThirdBetween;
    return own ? clearance : other > -1 ? other : Floats{} - 1;
  };
  const auto block_row = static_cast<std::size_t>(block.size.x), row = stride(1);
  const auto last = static_cast<std::size_t>(count - kLanes);  // if there are so many
  const Indices in_row = Indices{0, 1, 2, 3, 4, 5, 6, 7} < count;
  for (int z = begin.z; z < end.z; ++z) {
    std::size_t from = block.index(Int3(begin.x, begin.y, z) - piece.offset);
    float* to = &distance_[index(Int3(begin.x, begin.y, z))];
    for (int y = begin.y; y < end.y; ++y, from += block_row, to += row) {
      if (count < kLanes) {
        // What lies beyond the row is left as it is.
        store(in_row ? distance(from) : load<Floats>(to), to);
        continue;
      }
      for (std::size_t x = 0; x < last; x += kLanes) store(distance(from + x), to + x);
      store(distance(from + last), to + last);
    }
  }
}

}  // namespace talus::rocks
