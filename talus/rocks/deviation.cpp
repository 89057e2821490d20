#include "talus/rocks/deviation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "talus/base/lanes.h"
#include "talus/base/parallel.h"

namespace talus::rocks {
namespace {

constexpr float kSafety = 1.001f;  // for what is rounded to float

// A seed that competes in some tiling, but not by the rule of tiles.
struct Rival {
  const Seed* seed;
  Vec3f corner;   // of its cell, in voxels
  float stretch;  // the root of its distance grows at most by this for each voxel

  template <class X>
  X distance(X x, float y, float z) const {
    return seed->distance(x - corner.x, y - corner.y, z - corner.z);
  }
};

// Boxes of voxels that are compared as a whole, rows of kLanes.
constexpr Int3 kBoxSize(kLanes, 4, 4);

constexpr Indices kLane = {0, 1, 2, 3, 4, 5, 6, 7};

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
        least_growth_(*std::min_element(growth.begin(), growth.end())),
        boxes_((block_.size + kBoxSize - 1) / kBoxSize) {}

  // Voxels that some seed would take from their owner.
  std::size_t count_beaten() {
    measure_owners();
    beaten_.assign(owner_distance_.size(), 0);
    const Boxes all{Int3(0), boxes_};
    find_rivals(voxels(all), farthest_owner(all));
    scan(all, 0);
    return static_cast<std::size_t>(
        std::count_if(beaten_.begin(), beaten_.end(), [](std::int32_t b) { return b != 0; }));
  }

 private:
  // Boxes `min` to `max` of the block, the end excluded.
  struct Boxes {
    Int3 min, max;
  };
  VoxelBox voxels(const Boxes& boxes) const {
    return {block_.min + boxes.min * kBoxSize,
            block_.min + glm::min(boxes.max * kBoxSize, block_.size) - 1};
  }
  std::size_t index(const Int3& box) const {
    return static_cast<std::size_t>(box.x + boxes_.x * (box.y + boxes_.y * box.z));
  }

  // Owners' distances without penalty.
  void measure_owners() {
    owner_distance_.resize(block_.voxel_count() + kLanes);
    float* out = owner_distance_.data();
    block_.for_each_run([&](const Int3& first, int length, std::uint32_t owner) {
      const Candidate& candidate = block_.candidates[owner];
      const Vec3f at = Vec3f(first - layout_.voxels_per_cell * candidate.cell) + 0.5f;
      const Floats x = __builtin_convertvector(kLane, Floats) + at.x;
      // What is written beyond the run's end is overwritten by the next.
      for (int k = 0; k < length; k += kLanes)
        store(candidate.form->distance(x + static_cast<float>(k), at.y, at.z), out + k);
      out += length;
    });
    farthest_.clear();
    for (int z = 0; z < boxes_.z; ++z)
      for (int y = 0; y < boxes_.y; ++y)
        for (int x = 0; x < boxes_.x; ++x)
          farthest_.push_back(measure_box(voxels({Int3(x, y, z), Int3(x, y, z) + 1})));
  }

  float measure_box(const VoxelBox& box) const {
    Floats farthest{};
    for_each_row(box, [&](const Int3&, std::size_t row, const Indices& in_box) {
      const Floats distance = load<Floats>(&owner_distance_[row]);
      farthest = in_box & (distance > farthest) ? distance : farthest;
    });
    float most = 0;
    for (int k = 0; k < kLanes; ++k) most = std::max(most, farthest[k]);
    return most;
  }

  // Calls `use(first voxel, its element, lanes that belong to the box)` for the rows of a box.
  void for_each_row(const VoxelBox& box, auto&& use) const {
    const Indices in_box = kLane < box.max.x - box.min.x + 1;
    for (int z = box.min.z; z <= box.max.z; ++z)
      for (int y = box.min.y; y <= box.max.y; ++y) {
        const Int3 first(box.min.x, y, z);
        use(first, block_.index(first), in_box);
      }
  }

  float farthest_owner(const Boxes& boxes) const {
    float farthest = 0;
    for (int z = boxes.min.z; z < boxes.max.z; ++z)
      for (int y = boxes.min.y; y < boxes.max.y; ++y)
        for (int x = boxes.min.x; x < boxes.max.x; ++x)
          farthest = std::max(farthest, farthest_[index({x, y, z})]);
    return farthest;
  }

  // The seeds outside the window that can be nearer than the farthest owner.
  void find_rivals(const VoxelBox& box, float farthest) {
    const auto v = static_cast<float>(layout_.voxels_per_cell);
    const float reach = std::sqrt(farthest / least_growth_);
    const Int3 first = glm::floor((Vec3f(box.min) - reach) / v);
    const Int3 last = glm::floor((Vec3f(box.max + 1) + reach) / v);
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
          const Int3 cell(x, y, z);
          if (competes(cell)) continue;
          const Vec3f low = v * Vec3f(cell) - Vec3f(box.max + 1);
          const Vec3f high = Vec3f(box.min) - v * Vec3f(cell + 1);
          const Vec3f gap = glm::max(glm::max(low, high), Vec3f(0));
          if (growth_[layout_.cell_index(local(cell))] * glm::dot(gap, gap) < farthest)
            append_rivals(cell);
        }
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
  void append_rivals(const Int3& cell) {
    const Int3 in_cube = local(cell), cube = cube_of(cell);
    const CornerBox corners = layout_.seed_corners(in_cube);
    for (const std::uint32_t code : possible_codes(corners, cube)) {
      for (const Seed& s : table_.seeds().seeds(in_cube, code))
        rivals_.push_back({&s, Vec3f(layout_.voxels_per_cell * cell), kSafety * s.steepness()});
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

  // Halves a range of boxes as long as rivals, entries of `rivals_` from `first` on, can be nearer
  // than its farthest owner.
  void scan(const Boxes& boxes, std::size_t first) {
    const VoxelBox box = voxels(boxes);
    const float farthest = std::sqrt(farthest_owner(boxes));
    const Vec3f middle = 0.5f * Vec3f(box.min + box.max + 1);
    const float radius = 0.5f * glm::length(Vec3f(box.max - box.min));
    const std::size_t end = rivals_.size();
    for (std::size_t k = first; k < end; ++k) {
      const Rival rival = rivals_[k];
      if (std::sqrt(rival.distance(middle.x, middle.y, middle.z)) <
          farthest + radius * rival.stretch)
        rivals_.push_back(rival);
    }
    const Int3 size = boxes.max - boxes.min;
    if (size == Int3(1)) {
      for (std::size_t k = end; k < rivals_.size(); ++k) compare(rivals_[k], box);
    } else if (rivals_.size() > end) {
      const int axis = size.x > std::max(size.y, size.z) ? 0 : size.y > size.z ? 1 : 2;
      Boxes lower = boxes, upper = boxes;
      lower.max[axis] = upper.min[axis] = boxes.min[axis] + size[axis] / 2;
      scan(lower, end);
      scan(upper, end);
    }
    rivals_.resize(end);
  }

  void compare(const Rival& rival, const VoxelBox& box) {
    for_each_row(box, [&](const Int3& voxel, std::size_t row, const Indices& in_box) {
      const Vec3f at = Vec3f(voxel) + 0.5f;
      const Floats x = __builtin_convertvector(kLane, Floats) + at.x;
      const Indices nearer =
          in_box & (rival.distance(x, at.y, at.z) < load<Floats>(&owner_distance_[row]));
      store(load<Indices>(&beaten_[row]) | nearer, &beaten_[row]);
    });
  }

  const BlockTable& table_;
  const CellLayout& layout_;
  const Block& block_;
  const BlockPlace& place_;
  std::span<const float> growth_;
  float least_growth_;
  Int3 boxes_;                         // in the block, along each axis
  std::vector<float> owner_distance_;  // by voxel, with room for kLanes more
  std::vector<float> farthest_;        // by box, of its owners
  std::vector<Rival> rivals_;
  std::vector<std::int32_t> beaten_;  // by voxel, not 0 if it is
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
