#include "talus/rocks/blocks.h"

#include <algorithm>
#include <limits>
#include <span>

#include "talus/base/lanes.h"
#include "talus/base/parallel.h"
#include "talus/rocks/block_faces.h"
#include "talus/rocks/block_prints.h"
#include "talus/rocks/labels.h"

namespace talus::rocks {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Cells along one axis whose seeds compete in an interval, relative to the cube.
Interval candidate_cells(const CellLayout& layout, int axis, bool between) {
  if (!layout.colored[axis])
    return {-layout.repeat_margin_cells(), layout.period() + layout.repeat_margin_cells()};
  return between ? Interval{1, layout.period()} : Interval{-layout.radius, layout.radius + 1};
}

// Where a stone of cell `l` may own voxels along a colored axis, relative to its own cell.
Interval reach(const CellLayout& layout, int l) {
  const int margin = layout.margin_voxels(), v = layout.voxels_per_cell;
  const int period = layout.period_voxels();
  Interval r;
  if (l == 0) {
    r = {-margin, v + margin};
  } else {
    r.begin = l <= layout.radius ? -margin : v + margin;
    r.end = l < layout.period() - layout.radius ? period - margin : period + v + margin;
  }
  return {r.begin - l * v, r.end - l * v};
}

// Where any stone may own voxels along an axis that is not colored.
Interval repeating_reach(const CellLayout& layout) {
  const int margin = layout.repeat_margin_voxels();
  return {-margin, layout.voxels_per_cell + margin};
}

bool exists(const CellLayout& layout, const BlockType& type) {
  for (int axis = 0; axis < 3; ++axis)
    if (type.between[axis] && !layout.colored[axis]) return false;
  return true;
}

}  // namespace

std::span<const Candidate> Block::candidates_of(const Int3& cell) const {
  const Int3 at = cell - first_cell;
  for (int axis = 0; axis < 3; ++axis)
    if (at[axis] < 0 || at[axis] >= cells[axis]) return {};
  const auto c = static_cast<std::size_t>(at.x + cells.x * (at.y + cells.y * at.z));
  return std::span(candidates).subspan(cell_first[c], cell_first[c + 1] - cell_first[c]);
}

std::optional<std::uint32_t> Block::find(const Int3& cell, std::uint16_t seed) const {
  const std::span<const Candidate> found = candidates_of(cell);
  if (seed >= found.size()) return std::nullopt;
  return static_cast<std::uint32_t>(&found[seed] - candidates.data());
}

BlockTable::BlockTable(const TileParams& params, std::uint64_t seed, Job* job)
    : seeds_(params, seed) {
  make_penalties();
  for (int t = 0; t < 8; ++t) {
    const BlockType type{{(t & 1) != 0, (t & 2) != 0, (t & 4) != 0}};
    if (!exists(layout(), type)) continue;
    first_block_[t] = places_.size();
    const std::uint32_t codes = code_count(type.corners(), layout().colors);
    for (std::uint32_t code = 0; code < codes; ++code) places_.push_back({type, code});
  }
  blocks_.resize(places_.size());
  parallel_for(blocks_.size(), [&](std::size_t i) {
    check_cancelled(job);
    blocks_[i] = make_block(places_[i]);
    label(blocks_[i]);
  });
  parallel_for(blocks_.size(), [&](std::size_t i) {
    check_cancelled(job);
    compare_stones(i);
  });
}

// Sets a labeled block's patches and prints.
void BlockTable::compare_stones(std::size_t index) {
  Block& block = blocks_[index];
  BlockFaces faces(block, places_[index].type, adjacent(places_[index]), layout());
  BlockPrints prints(block, faces.parties());
  std::vector<SharedFace> shared;
  shared.reserve(block.voxel_count() / 2);
  faces.for_each([&](const Face& face) {
    prints.add(face);
    if (!face.shared) return;
    const auto [first, second] = std::minmax(face.lower, face.upper);
    shared.push_back({first, second, glm::i16vec3(face.middle())});
  });
  block.prints = prints.prints();
  block.patches = find_patches(faces.parties(), block.candidates.size(), shared);
}

void BlockTable::make_penalties() {
  const CellLayout& grid = layout();
  // Every voxel of a block, or next to a stone, lies less than two periods from the cell in
  // question; rows are read up to a group beyond their end.
  penalty_offset_ = 2 * grid.period_voxels();
  for (int i = -penalty_offset_; i < penalty_offset_ + kLanes; ++i)
    centers_.push_back(static_cast<float>(i) + 0.5f);
  const float ramp = 0.5f * static_cast<float>(grid.margin_voxels());
  for (int l = 0; l <= grid.period(); ++l) {
    const Interval r = l < grid.period() ? reach(grid, l) : repeating_reach(grid);
    std::vector<float> row;
    for (const float center : centers_) {
      const float u =
          std::min(center - static_cast<float>(r.begin), static_cast<float>(r.end) - center);
      const float t = std::min(u / ramp, 1.0f);
      row.push_back(t > 0 ? 1 / (t * t * (3 - 2 * t)) : kInfinity);
    }
    penalties_.push_back(std::move(row));
  }
}

Block BlockTable::make_block(const BlockPlace& place) const {
  const auto& [type, code] = place;
  const CellLayout& grid = layout();
  Block block;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval voxels = interval(grid, axis, type.between[axis]);
    block.min[axis] = voxels.begin;
    block.size[axis] = voxels.end - voxels.begin;
    const Interval cells = candidate_cells(grid, axis, type.between[axis]);
    block.first_cell[axis] = cells.begin;
    block.cells[axis] = cells.end - cells.begin;
  }
  for (int z = 0; z < block.cells.z; ++z)
    for (int y = 0; y < block.cells.y; ++y)
      for (int x = 0; x < block.cells.x; ++x) {
        const Int3 cell = block.first_cell + Int3(x, y, z);
        Int3 cube;  // the cell's own
        for (int axis = 0; axis < 3; ++axis) cube[axis] = floor_div(cell[axis], grid.period());
        const Int3 local = cell - grid.period() * cube;
        const std::uint32_t seed_code =
            color_code(grid.seed_corners(local), grid.colors, [&](const Int3& corner) {
              return decode_color(type.corners(), grid.colors, code,
                                  grid.colored_corner(cube + corner));
            });
        const std::span<const Seed> seeds = seeds_.seeds(local, seed_code);
        block.cell_first.push_back(static_cast<std::uint32_t>(block.candidates.size()));
        Candidate candidate{.cell = cell};
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          const int zero = penalty_offset_ - grid.voxels_per_cell * cell[axis];
          candidate.centers[a] = centers_.data() + zero;
          candidate.penalties[a] = penalties(axis, local[axis]).data() + zero;
        }
        for (std::size_t k = 0; k < seeds.size(); ++k) {
          candidate.seed = static_cast<std::uint16_t>(k);
          candidate.form = &seeds[k];
          block.candidates.push_back(candidate);
        }
      }
  block.cell_first.push_back(static_cast<std::uint32_t>(block.candidates.size()));
  return block;
}

std::vector<AdjacentBlock> BlockTable::adjacent(const BlockPlace& place) const {
  const CellLayout& grid = layout();
  std::vector<AdjacentBlock> result;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (grid.colored[axis] ? !place.type.between[axis] : side == 0) continue;
      BlockType around = place.type;
      around.between[axis] = false;
      Int3 cube(0);
      cube[axis] = side;
      const std::uint32_t code = color_code(around.corners(), grid.colors, [&](const Int3& corner) {
        return decode_color(place.type.corners(), grid.colors, place.code,
                            grid.colored_corner(cube + corner));
      });
      result.push_back({&block(around, code), axis, cube});
    }
  return result;
}

}  // namespace talus::rocks
