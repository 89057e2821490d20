#include "talus/rocks/blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "talus/base/parallel.h"

namespace talus::rocks {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Cells along one axis whose seeds compete in an interval, relative to the cube.
Interval candidate_cells(const CellLayout& layout, bool between) {
  return between ? Interval{1, layout.period()} : Interval{-layout.radius, layout.radius + 1};
}

// Where a stone of cell `l` may own voxels along one axis, relative to its own cell.
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

int cell_in_period(const CellLayout& layout, int cell) {
  return cell < 0 ? cell + layout.period() : cell;
}

// Best and second-best distance of a row of voxels, and who holds the best.
struct RowState {
  explicit RowState(std::size_t width) : best(width), second(width), owner(width) {}
  void reset() {
    std::fill(best.begin(), best.end(), kInfinity);
    std::fill(second.begin(), second.end(), kInfinity);
    std::fill(owner.begin(), owner.end(), 0u);
  }
  // Lets candidate `c` compete; voxel x of the row lies at `first` + x relative to its cell.
  void offer(const Seed& form, const float* penalty, float row_penalty, std::uint32_t c, int first,
             float y, float z) {
    float* __restrict best_d = best.data();
    float* __restrict second_d = second.data();
    std::uint32_t* __restrict who = owner.data();
    const int width = static_cast<int>(best.size());
    for (int x = 0; x < width; ++x) {
      const float d = form.distance(static_cast<float>(first + x) + 0.5f, y, z) *
                      std::max(penalty[x], row_penalty);
      const float b = best_d[x];
      second_d[x] = std::min(second_d[x], std::max(d, b));
      who[x] = d < b ? c : who[x];
      best_d[x] = std::min(d, b);
    }
  }

  std::vector<float> best, second;
  std::vector<std::uint32_t> owner;
};

}  // namespace

std::optional<std::uint16_t> Block::find(const Int3& cell, std::uint16_t seed) const {
  const auto key = [](const Int3& c, std::uint16_t s) { return std::array{c.z, c.y, c.x, int{s}}; };
  const auto found = std::lower_bound(
      candidates.begin(), candidates.end(), key(cell, seed),
      [&](const Candidate& c, const auto& wanted) { return key(c.cell, c.seed) < wanted; });
  if (found == candidates.end() || found->cell != cell || found->seed != seed) return std::nullopt;
  return static_cast<std::uint16_t>(found - candidates.begin());
}

BlockTable::BlockTable(const TileParams& params, std::uint64_t seed, Job* job)
    : seeds_(params, seed) {
  make_penalties();
  struct Task {
    BlockType type;
    std::uint32_t code;
  };
  std::vector<Task> tasks;
  for (int t = 0; t < 8; ++t) {
    const BlockType type{{(t & 1) != 0, (t & 2) != 0, (t & 4) != 0}};
    first_block_[t] = tasks.size();
    const std::uint32_t codes = code_count(type.corners(), layout().colors);
    for (std::uint32_t code = 0; code < codes; ++code) tasks.push_back({type, code});
  }
  blocks_.resize(tasks.size());
  parallel_for(tasks.size(), [&](std::size_t i) {
    check_cancelled(job);
    blocks_[i] = make_block(tasks[i].type, tasks[i].code);
    label(blocks_[i]);
  });
}

void BlockTable::make_penalties() {
  const CellLayout& grid = layout();
  // Every voxel of a block lies less than two periods from the cells that compete for it.
  penalty_offset_ = 2 * grid.period_voxels();
  const float ramp = 0.5f * static_cast<float>(grid.margin_voxels());
  for (int l = 0; l < grid.period(); ++l) {
    const Interval r = reach(grid, l);
    std::vector<float> row(static_cast<std::size_t>(2 * penalty_offset_));
    for (std::size_t i = 0; i < row.size(); ++i) {
      const float center = static_cast<float>(static_cast<int>(i) - penalty_offset_) + 0.5f;
      const float u =
          std::min(center - static_cast<float>(r.begin), static_cast<float>(r.end) - center);
      const float t = std::min(u / ramp, 1.0f);
      row[i] = t > 0 ? 1 / (t * t * (3 - 2 * t)) : kInfinity;
    }
    penalty_.push_back(std::move(row));
  }
}

Block BlockTable::make_block(const BlockType& type, std::uint32_t code) const {
  const CellLayout& grid = layout();
  Block block;
  Interval cells[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Interval voxels = interval(grid, type.between[axis]);
    block.min[axis] = voxels.begin;
    block.size[axis] = voxels.end - voxels.begin;
    cells[axis] = candidate_cells(grid, type.between[axis]);
  }
  for (int z = cells[2].begin; z < cells[2].end; ++z)
    for (int y = cells[1].begin; y < cells[1].end; ++y)
      for (int x = cells[0].begin; x < cells[0].end; ++x) {
        const Int3 cell(x, y, z);
        Int3 local, cube;  // the cell in its own cube, and where that cube lies
        for (int axis = 0; axis < 3; ++axis) {
          local[axis] = cell_in_period(grid, cell[axis]);
          cube[axis] = cell[axis] < 0 ? -1 : 0;
        }
        const std::uint32_t seed_code =
            color_code(grid.seed_corners(local), grid.colors, [&](const Int3& corner) {
              return decode_color(type.corners(), grid.colors, code, cube + corner);
            });
        const std::span<const Seed> seeds = seeds_.seeds(local, seed_code);
        for (std::size_t k = 0; k < seeds.size(); ++k)
          block.candidates.push_back({cell, static_cast<std::uint16_t>(k), &seeds[k]});
      }
  return block;
}

// owner(v) = argmin d / phi over the candidates, the first of equals.
void BlockTable::label(Block& block) const {
  const CellLayout& grid = layout();
  const auto width = static_cast<std::size_t>(block.size.x);
  const std::size_t count = width * static_cast<std::size_t>(block.size.y * block.size.z);
  block.owner.resize(count);
  block.nearest.resize(count);
  block.second.resize(count);

  block.extent.resize(block.candidates.size());
  RowState row(width);
  std::size_t out = 0;
  for (int z = block.min.z; z < block.min.z + block.size.z; ++z)
    for (int y = block.min.y; y < block.min.y + block.size.y; ++y) {
      row.reset();
      for (std::size_t c = 0; c < block.candidates.size(); ++c) {
        const Candidate& candidate = block.candidates[c];
        const Int3 origin = grid.voxels_per_cell * candidate.cell;
        const Int3 local(cell_in_period(grid, candidate.cell.x),
                         cell_in_period(grid, candidate.cell.y),
                         cell_in_period(grid, candidate.cell.z));
        const float row_penalty =
            std::max(penalty(local.y, y - origin.y), penalty(local.z, z - origin.z));
        if (row_penalty == kInfinity) continue;
        const int first = block.min.x - origin.x;
        const float* const x_penalty = &penalty_[static_cast<std::size_t>(local.x)]
                                                [static_cast<std::size_t>(first + penalty_offset_)];
        const Seed form = *candidate.form;
        const float fy = static_cast<float>(y - origin.y) + 0.5f;
        const float fz = static_cast<float>(z - origin.z) + 0.5f;
        row.offer(form, x_penalty, row_penalty, static_cast<std::uint32_t>(c), first, fy, fz);
      }
      for (std::size_t x = 0; x < width; ++x, ++out) {
        block.owner[out] = static_cast<std::uint16_t>(row.owner[x]);
        const Int3 voxel(block.min.x + static_cast<int>(x), y, z);
        block.extent[row.owner[x]].include({voxel, voxel});
        block.nearest[out] = std::sqrt(row.best[x]);
        block.second[out] = std::sqrt(row.second[x]);
      }
    }
}

}  // namespace talus::rocks
