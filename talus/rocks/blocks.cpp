#include "talus/rocks/blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>

#include "talus/base/parallel.h"

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

int index_in_cube(const CellLayout& layout, int cell) {
  return cell - layout.period() * floor_div(cell, layout.period());
}

// Neighboring voxels of a row, labeled together.
constexpr int kLanes = 8;
using Floats [[gnu::vector_size(4 * kLanes)]] = float;
using Indices [[gnu::vector_size(4 * kLanes)]] = std::int32_t;

Floats load(const float* from) {
  Floats result;
  std::memcpy(&result, from, sizeof result);
  return result;
}

// A candidate along a row of voxels: its distance is ((xx dx + linear) dx + constant) times the
// larger of the penalties, dx = x - position.
struct RowForm {
  float position, xx, linear, constant;
  float penalty;           // of the row's y and z
  const float* centers;    // x of the row's voxels, relative to the candidate's cell
  const float* penalties;  // of that x
};

// Distances and owners of a row of voxels.
struct RowLabels {
  std::vector<float> nearest, second;
  std::vector<std::int32_t> owner;
};

// The rule for `groups` times kLanes voxels from element `at` of the row on: the least d / phi, the
// first of equals.
template <std::size_t groups>
void compete(std::span<const RowForm> forms, std::size_t at, RowLabels& row) {
  Floats nearest[groups], second[groups];
  Indices owner[groups], index{};
  for (std::size_t g = 0; g < groups; ++g) {
    nearest[g] = second[g] = Floats{} + kInfinity;
    owner[g] = index;
  }
  for (const RowForm& form : forms) {
    const Floats row_penalty = form.penalty - Floats{};
    for (std::size_t g = 0; g < groups; ++g) {
      const Floats dx = load(form.centers + at + g * kLanes) - form.position;
      const Floats along_x = load(form.penalties + at + g * kLanes);
      const Floats penalty = along_x > row_penalty ? along_x : row_penalty;
      const Floats d = ((form.xx * dx + form.linear) * dx + form.constant) * penalty;
      const Floats farther = d > nearest[g] ? d : nearest[g];
      second[g] = farther < second[g] ? farther : second[g];
      owner[g] = d < nearest[g] ? index : owner[g];
      nearest[g] = d < nearest[g] ? d : nearest[g];
    }
    index += 1;
  }
  std::memcpy(&row.nearest[at], nearest, sizeof nearest);
  std::memcpy(&row.second[at], second, sizeof second);
  std::memcpy(&row.owner[at], owner, sizeof owner);
}

// The runs of a row of voxels, found where the owner changes.
void append_runs(std::span<const std::int32_t> owners, int first, std::vector<RowRun>& runs) {
  for (std::size_t x = 0; x < owners.size();) {
    const std::size_t begin = x;
    while (x < owners.size() && owners[x] == owners[begin]) ++x;
    runs.push_back({first + static_cast<int>(begin), first + static_cast<int>(x),
                    static_cast<std::uint32_t>(owners[begin])});
  }
}

// Orders a block's runs by owner, and finds the box around each owner's.
void group_by_owner(Block& block) {
  block.run_first.assign(block.candidates.size() + 1, 0);
  for (const RowRun& run : block.rows) ++block.run_first[run.owner + 1];
  std::partial_sum(block.run_first.begin(), block.run_first.end(), block.run_first.begin());

  std::vector<std::uint32_t> next(block.run_first);
  block.runs.resize(block.rows.size());
  block.extent.resize(block.candidates.size());
  for (int z = block.min.z; z < block.min.z + block.size.z; ++z)
    for (int y = block.min.y; y < block.min.y + block.size.y; ++y)
      for (const RowRun& run : block.row(y, z)) {
        block.runs[next[run.owner]++] = {Int3(run.begin, y, z), run.end - run.begin};
        block.extent[run.owner].include({Int3(run.begin, y, z), Int3(run.end - 1, y, z)});
      }
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
    blocks_[i].patches = patches(places_[i]);
  });
}

void BlockTable::make_penalties() {
  const CellLayout& grid = layout();
  // Every voxel of a block, or next to a stone, lies less than two periods from the cell in
  // question; rows are read up to kLanes voxels beyond their end.
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
        for (std::size_t k = 0; k < seeds.size(); ++k)
          block.candidates.push_back({cell, static_cast<std::uint16_t>(k), &seeds[k]});
      }
  block.cell_first.push_back(static_cast<std::uint32_t>(block.candidates.size()));
  return block;
}

void BlockTable::label(Block& block) const {
  const CellLayout& grid = layout();
  // What a candidate looks up along an axis, from the block's first voxel on.
  struct Axis {
    const float* centers;
    const float* penalties;
  };
  std::vector<std::array<Axis, 3>> axes;
  std::vector<RowForm> forms;
  for (const Candidate& candidate : block.candidates) {
    std::array<Axis, 3> lookup;
    for (int axis = 0; axis < 3; ++axis) {
      const auto first = static_cast<std::size_t>(
          block.min[axis] - grid.voxels_per_cell * candidate.cell[axis] + penalty_offset_);
      const int l = index_in_cube(grid, candidate.cell[axis]);
      lookup[static_cast<std::size_t>(axis)] = {&centers_[first], &penalties(axis, l)[first]};
    }
    axes.push_back(lookup);
    forms.push_back({.position = candidate.form->position.x,
                     .xx = candidate.form->xx,
                     .centers = lookup[0].centers,
                     .penalties = lookup[0].penalties});
  }

  const auto width = static_cast<std::size_t>(block.size.x);
  const std::size_t padded = (width + kLanes - 1) / kLanes * kLanes;
  RowLabels row{std::vector<float>(padded), std::vector<float>(padded),
                std::vector<std::int32_t>(padded)};
  const std::size_t count = width * static_cast<std::size_t>(block.size.y * block.size.z);
  block.clearance.resize(count);
  std::size_t out = 0;
  for (int z = 0; z < block.size.z; ++z)
    for (int y = 0; y < block.size.y; ++y, out += width) {
      for (std::size_t c = 0; c < forms.size(); ++c) {
        const Seed& seed = *block.candidates[c].form;
        const Axis &along_y = axes[c][1], &along_z = axes[c][2];
        const float dy = along_y.centers[y] - seed.position.y;
        const float dz = along_z.centers[z] - seed.position.z;
        forms[c].linear = seed.xy * dy + seed.xz * dz;
        forms[c].constant = (seed.yy * dy + seed.yz * dz) * dy + seed.zz * (dz * dz);
        forms[c].penalty = std::max(along_y.penalties[y], along_z.penalties[z]);
      }
      std::size_t x = 0;
      for (; x + 3 * kLanes <= padded; x += 3 * kLanes) compete<3>(forms, x, row);
      for (; x < padded; x += kLanes) compete<1>(forms, x, row);
      float* const clearance = &block.clearance[out];
      for (x = 0; x < width; ++x)
        clearance[x] =
            std::min(0.5f * (std::sqrt(row.second[x]) - std::sqrt(row.nearest[x])), 1.0f);
      block.row_first.push_back(static_cast<std::uint32_t>(block.rows.size()));
      append_runs(std::span(row.owner).first(width), block.min.x, block.rows);
    }
  block.row_first.push_back(static_cast<std::uint32_t>(block.rows.size()));
  group_by_owner(block);
}

BlockPatches BlockTable::patches(const BlockPlace& place) const {
  const auto& [type, code] = place;
  const CellLayout& grid = layout();
  // The blocks around corners on either side of an interval between them, and the next cube's along
  // an axis where all cubes are the same.
  std::vector<AdjacentBlock> adjacent;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (grid.colored[axis] ? !type.between[axis] : side == 0) continue;
      BlockType around = type;
      around.between[axis] = false;
      Int3 cube(0);
      cube[axis] = side;
      const std::uint32_t its_code =
          color_code(around.corners(), grid.colors, [&](const Int3& corner) {
            return decode_color(type.corners(), grid.colors, code,
                                grid.colored_corner(cube + corner));
          });
      adjacent.push_back({&block(around, its_code), axis, cube});
    }
  return find_patches(block(type, code), type, adjacent, *this);
}

}  // namespace talus::rocks
