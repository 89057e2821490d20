#include "talus/rocks/deviation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "talus/base/parallel.h"

namespace talus::rocks {
namespace {

constexpr float kSafety = 1.001f;  // for what is rounded to float

// A seed that competes in some tiling, but not by the rule of tiles.
struct Rival {
  const Seed* seed;
  Vec3f corner;   // of its cell, in voxels
  float stretch;  // the root of its distance grows at most by this for each voxel

  float distance(const Vec3f& at) const {
    const Vec3f p = at - corner;
    return seed->distance(p.x, p.y, p.z);
  }
};

// For every cell the least growth of its seeds' distances, over all its colors.
std::vector<float> find_growth(const SeedTable& seeds) {
  const CellLayout& layout = seeds.layout();
  std::vector<float> growth;
  for (std::size_t c = 0; c < layout.cell_count(); ++c) {
    const Int3 cell = layout.cell_at(c);
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t code = 0; code < code_count(layout.seed_corners(cell), layout.colors);
         ++code)
      for (const Seed& seed : seeds.seeds(cell, code)) least = std::min(least, seed.growth);
    growth.push_back(least);
  }
  return growth;
}

// Compares one block with the seeds around its window.
class BlockScan {
 public:
  BlockScan(const BlockTable& table, std::size_t index, std::span<const float> growth)
      : table_(table),
        layout_(table.layout()),
        block_(table.blocks()[index]),
        place_(table.places()[index]),
        growth_(growth),
        least_growth_(*std::min_element(growth.begin(), growth.end())) {}

  // Voxels that some seed would take from their owner.
  std::size_t count_beaten() {
    measure_owners();
    beaten_.assign(owner_distance_.size(), 0);
    const VoxelBox all{block_.min, block_.min + block_.size - 1};
    scan(all, find_rivals(all));
    return static_cast<std::size_t>(std::count(beaten_.begin(), beaten_.end(), 1));
  }

 private:
  // Owners' distances without penalty.
  void measure_owners() {
    owner_distance_.resize(block_.voxel_count());
    float* out = owner_distance_.data();
    block_.for_each_run([&](const Int3& first, int length, std::uint32_t owner) {
      const Candidate& candidate = block_.candidates[owner];
      const Vec3f at = Vec3f(first - layout_.voxels_per_cell * candidate.cell) + 0.5f;
      for (int k = 0; k < length; ++k)
        *out++ = candidate.form->distance(at.x + static_cast<float>(k), at.y, at.z);
    });
  }

  float farthest_owner(const VoxelBox& box) const {
    float farthest = 0;
    for (int z = box.min.z; z <= box.max.z; ++z)
      for (int y = box.min.y; y <= box.max.y; ++y) {
        const float* const row = &owner_distance_[block_.index(Int3(box.min.x, y, z))];
        for (int x = 0; x <= box.max.x - box.min.x; ++x) farthest = std::max(farthest, row[x]);
      }
    return farthest;
  }

  // The seeds outside the window that can be nearer than the farthest owner.
  std::vector<Rival> find_rivals(const VoxelBox& box) const {
    const float farthest = farthest_owner(box), v = static_cast<float>(layout_.voxels_per_cell);
    const float reach = std::sqrt(farthest / least_growth_);
    const Int3 first = glm::floor((Vec3f(box.min) - reach) / v);
    const Int3 last = glm::floor((Vec3f(box.max + 1) + reach) / v);
    std::vector<Rival> rivals;
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
          const Int3 cell(x, y, z);
          if (competes(cell)) continue;
          const Vec3f low = v * Vec3f(cell) - Vec3f(box.max + 1);
          const Vec3f high = Vec3f(box.min) - v * Vec3f(cell + 1);
          const Vec3f gap = glm::max(glm::max(low, high), Vec3f(0));
          if (growth_[layout_.cell_index(local(cell))] * glm::dot(gap, gap) < farthest)
            append_rivals(cell, rivals);
        }
    return rivals;
  }

  bool competes(const Int3& cell) const {
    const Int3 at = cell - block_.first_cell;
    return std::min({at.x, at.y, at.z}) >= 0 && at.x < block_.cells.x && at.y < block_.cells.y &&
           at.z < block_.cells.z;
  }
  Int3 cube_of(const Int3& cell) const {
    const int p = layout_.period();
    return {floor_div(cell.x, p), floor_div(cell.y, p), floor_div(cell.z, p)};
  }
  Int3 local(const Int3& cell) const { return cell - layout_.period() * cube_of(cell); }

  // The seeds of a cell for all colors that it can have beside this block.
  void append_rivals(const Int3& cell, std::vector<Rival>& rivals) const {
    const Int3 in_cube = local(cell), cube = cube_of(cell);
    const CornerBox corners = layout_.seed_corners(in_cube);
    for (const std::uint32_t code : possible_codes(corners, cube)) {
      for (const Seed& s : table_.seeds().seeds(in_cube, code))
        rivals.push_back({&s, Vec3f(layout_.voxels_per_cell * cell), kSafety * s.steepness()});
    }
  }

  // The codes of colors at a box of corners that agree with those at the block's own.
  std::vector<std::uint32_t> possible_codes(const CornerBox& corners, const Int3& cube) const {
    const CornerBox own = place_.type.corners();
    std::vector<std::uint32_t> codes = {0};
    for (int i = 0; i < corners.corners(); ++i) {
      const Int3 step(i % corners.count.x, i / corners.count.x % corners.count.y,
                      i / (corners.count.x * corners.count.y));
      const Int3 at = layout_.colored_corner(cube + corners.first + step);
      const bool known = std::min({at.x, at.y, at.z}) >= 0 && at.x < own.count.x &&
                         at.y < own.count.y && at.z < own.count.z;
      const int first = known ? decode_color(own, layout_.colors, place_.code, at) : 0;
      const int last = known ? first : layout_.colors - 1;
      std::vector<std::uint32_t> longer;
      for (int color = first; color <= last; ++color)
        for (const std::uint32_t code : codes)
          longer.push_back(code + power(layout_.colors, i) * static_cast<std::uint32_t>(color));
      codes.swap(longer);
    }
    return codes;
  }

  // Halves a box as long as rivals can be nearer than its farthest owner.
  void scan(const VoxelBox& box, std::span<const Rival> rivals) {
    const float farthest = std::sqrt(farthest_owner(box));
    const Vec3f middle = 0.5f * Vec3f(box.min + box.max + 1);
    const float radius = 0.5f * glm::length(Vec3f(box.max - box.min));
    std::vector<Rival> nearer;
    for (const Rival& rival : rivals)
      if (std::sqrt(rival.distance(middle)) < farthest + radius * rival.stretch)
        nearer.push_back(rival);
    if (nearer.empty()) return;

    constexpr int kSmallest = 4;  // voxels along an edge
    const Int3 size = box.max - box.min + 1;
    const int axis = size.x > std::max(size.y, size.z) ? 0 : size.y > size.z ? 1 : 2;
    if (size[axis] <= kSmallest) {
      for (const Rival& rival : nearer) compare(rival, box);
      return;
    }
    VoxelBox lower = box, upper = box;
    upper.min[axis] = box.min[axis] + size[axis] / 2;
    lower.max[axis] = upper.min[axis] - 1;
    scan(lower, nearer);
    scan(upper, nearer);
  }

  void compare(const Rival& rival, const VoxelBox& box) {
    for (int z = box.min.z; z <= box.max.z; ++z)
      for (int y = box.min.y; y <= box.max.y; ++y) {
        const Vec3f at = Vec3f(box.min.x, y, z) + 0.5f;
        const std::size_t row = block_.index(Int3(box.min.x, y, z));
        for (std::size_t k = 0; k <= static_cast<std::size_t>(box.max.x - box.min.x); ++k)
          if (rival.distance(at + Vec3f(static_cast<float>(k), 0, 0)) < owner_distance_[row + k])
            beaten_[row + k] = 1;
      }
  }

  const BlockTable& table_;
  const CellLayout& layout_;
  const Block& block_;
  const BlockPlace& place_;
  std::span<const float> growth_;
  float least_growth_;
  std::vector<float> owner_distance_;
  std::vector<std::uint8_t> beaten_;
};

}  // namespace

double deviation_bound(const BlockTable& table, Job* job) {
  const CellLayout& layout = table.layout();
  const std::vector<float> growth = find_growth(table.seeds());
  std::vector<std::size_t> beaten(table.blocks().size());
  parallel_for(beaten.size(), [&](std::size_t i) {
    check_cancelled(job);
    beaten[i] = BlockScan(table, i, growth).count_beaten();
  });

  // A cube of a tiling holds one block of each type, every coloring as likely as any other.
  double voxels = 0;
  for (std::size_t i = 0; i < beaten.size(); ++i)
    voxels += static_cast<double>(beaten[i]) /
              code_count(table.places()[i].type.corners(), layout.colors);
  return voxels / std::pow(layout.period_voxels(), 3);
}

std::optional<int> find_sufficient_n(const TileParams& params, std::uint64_t seed, Job* job) {
  constexpr int kLargest = 9, kVoxelsPerCell = 4;
  TileParams larger = params;
  // What a corner fixes grows with every second n.
  for (larger.n = params.n + 2 - (params.n - 3) % 2; larger.n <= kLargest; larger.n += 2) {
    larger.voxels_per_edge = kVoxelsPerCell * larger.n;
    if (!fits_memory(larger)) return std::nullopt;
    if (deviation_bound(BlockTable(larger, seed, job), job) < kMuchDeviation) return larger.n;
  }
  return std::nullopt;
}

}  // namespace talus::rocks
