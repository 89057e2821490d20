#include "talus/rocks/patches.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "talus/rocks/blocks.h"

namespace talus::rocks {
namespace {

// A stone as far as a block is concerned: its candidates first, then those of adjacent blocks only.
struct Party {
  Int3 cell;
  std::uint16_t seed;
};

// Whether the colors that a stone of `cell` depends on determine a block at the cube at the origin.
bool knows(const Int3& cell, const BlockType& type, int period) {
  for (int axis = 0; axis < 3; ++axis) {
    const int cube = floor_div(cell[axis], period);
    const bool at_corner = cell[axis] == cube * period;
    const bool after_last = cube == -1 && !at_corner && !type.between[axis];
    const bool in_own_cube = cube == 0 && !(at_corner && type.between[axis]);
    if (!after_last && !in_own_cube) return false;
  }
  return true;
}

// Stable, by key(item) < keys.
template <class T>
void counting_sort(std::vector<T>& items, std::size_t keys, auto&& key) {
  std::vector<std::uint32_t> next(keys + 1, 0);
  for (const T& item : items) ++next[key(item) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<T> sorted(items.size());
  for (const T& item : items) sorted[next[key(item)]++] = item;
  items.swap(sorted);
}

class PatchFinder {
 public:
  PatchFinder(const Block& block, const CellLayout& layout)
      : block_(block), layout_(layout), own_ids_(block.candidates.size()) {
    std::iota(own_ids_.begin(), own_ids_.end(), 0u);
    for (const Candidate& c : block.candidates) parties_.push_back({c.cell, c.seed});
  }

  void collect_within() {
    const Int3 end = block_.min + block_.size;
    for (int z = block_.min.z; z < end.z; ++z)
      for (int y = block_.min.y; y < end.y; ++y) {
        const Row row{block_.row(y, z), own_ids_};
        for (std::size_t i = 0; i + 1 < row.runs.size(); ++i)
          add(row.runs[i].owner, row.runs[i + 1].owner, {Int3(row.runs[i].end - 1, y, z), 1, 0, 1});
        if (y + 1 < end.y) compare_rows(row, {block_.row(y + 1, z), own_ids_}, y, z, 1);
        if (z + 1 < end.z) compare_rows(row, {block_.row(y, z + 1), own_ids_}, y, z, 2);
      }
  }

  void collect_across(const AdjacentBlock& adjacent) {
    const std::vector<std::uint32_t> its_ids = ids_of(adjacent);
    const int axis = adjacent.axis;
    const bool above = adjacent.cube[axis] > 0;
    const Int3 to_its_cube = -layout_.period_voxels() * adjacent.cube;
    // The layer of voxels on either side of the plane.
    const int own = above ? block_.min[axis] + block_.size[axis] - 1 : block_.min[axis];
    const int low = above ? own : own - 1;
    for_each_row(axis, own, [&](int y, int z) {
      Int3 across(0, y, z);
      across[axis] += above ? 1 : -1;
      across += to_its_cube;
      const Row row{block_.row(y, z), own_ids_};
      const Row its{adjacent.block->row(across.y, across.z), its_ids};
      const Row &lower = above ? row : its, &upper = above ? its : row;
      if (axis == 0)
        add(lower.ids[lower.runs.back().owner], upper.ids[upper.runs.front().owner],
            {Int3(low, y, z), 1, 0, 1});
      else
        compare_rows(lower, upper, axis == 1 ? low : y, axis == 2 ? low : z, axis);
    });
  }

  // The faces found, by stone and neighbor.
  BlockPatches patches(const BlockType& type) {
    counting_sort(faces_, parties_.size(), [](const Meeting& m) { return m.other; });
    counting_sort(faces_, block_.candidates.size(), [](const Meeting& m) { return m.own; });
    BlockPatches result;
    result.runs.reserve(faces_.size());
    const Meeting* last = nullptr;
    for (const Meeting& m : faces_) {
      if (!last || m.own != last->own || m.other != last->other) {
        // Candidates without voxels have no patches.
        result.first.resize(m.own + 1, static_cast<std::uint32_t>(result.patches.size()));
        const Party& other = parties_[m.other];
        result.patches.push_back({.cell = other.cell,
                                  .seed = other.seed,
                                  .known_to_both = knows(other.cell, type, layout_.period()),
                                  .first_run = static_cast<std::uint32_t>(result.runs.size())});
      }
      last = &m;
      result.runs.push_back(m.faces);
      Patch& patch = result.patches.back();
      patch.end_run = static_cast<std::uint32_t>(result.runs.size());
      patch.faces += m.faces.length;
      patch.sum += std::int64_t{m.faces.length} * glm::i64vec3(m.faces.middle());
      patch.sum.x += std::int64_t{m.faces.length} * (m.faces.length - 1);
    }
    result.first.resize(block_.candidates.size() + 1,
                        static_cast<std::uint32_t>(result.patches.size()));
    return result;
  }

 private:
  struct Meeting {
    std::uint32_t own, other;  // parties
    FaceRun faces;
  };
  struct Row {
    std::span<const RowRun> runs;
    std::span<const std::uint32_t> ids;  // party for each owner
  };

  std::vector<std::uint32_t> ids_of(const AdjacentBlock& adjacent) {
    std::vector<std::uint32_t> ids;
    for (const Candidate& c : adjacent.block->candidates) {
      const Int3 cell = c.cell + layout_.period() * adjacent.cube;
      if (const auto own = block_.find(cell, c.seed)) {
        ids.push_back(*own);
      } else {
        ids.push_back(static_cast<std::uint32_t>(parties_.size()));
        parties_.push_back({cell, c.seed});
      }
    }
    return ids;
  }

  // The block's rows that touch a plane across an axis; `own` is the layer of voxels at the plane.
  void for_each_row(int axis, int own, auto&& use) const {
    Int3 begin = block_.min, end = block_.min + block_.size;
    if (axis != 0) begin[axis] = own, end[axis] = own + 1;
    for (int z = begin.z; z < end.z; ++z)
      for (int y = begin.y; y < end.y; ++y) use(y, z);
  }

  // Adds the faces between two rows, the lower one at y and z, the other next to it along `axis`.
  void compare_rows(const Row& lower, const Row& upper, int y, int z, int axis) {
    for (auto l = lower.runs.begin(), u = upper.runs.begin(); l != lower.runs.end();) {
      const int begin = std::max(l->begin, u->begin), end = std::min(l->end, u->end);
      add(lower.ids[l->owner], upper.ids[u->owner],
          {Int3(begin, y, z), end - begin, static_cast<std::int8_t>(axis), 1});
      const bool lower_ends = l->end == end, upper_ends = u->end == end;
      l += lower_ends;
      u += upper_ends;
    }
  }

  // Adds upper faces of voxels of the party `lower`, seen from either side.
  void add(std::uint32_t lower, std::uint32_t upper, FaceRun faces) {
    if (lower == upper) return;
    const std::size_t candidates = block_.candidates.size();
    if (lower < candidates) faces_.push_back({lower, upper, faces});
    ++faces.voxel[faces.axis];
    faces.side = -1;
    if (upper < candidates) faces_.push_back({upper, lower, faces});
  }

  const Block& block_;
  const CellLayout& layout_;
  std::vector<Party> parties_;
  std::vector<std::uint32_t> own_ids_;
  std::vector<Meeting> faces_;
};

}  // namespace

BlockPatches find_patches(const Block& block, const BlockType& type,
                          std::span<const AdjacentBlock> adjacent, const CellLayout& layout) {
  PatchFinder finder(block, layout);
  finder.collect_within();
  for (const AdjacentBlock& a : adjacent) finder.collect_across(a);
  return finder.patches(type);
}

}  // namespace talus::rocks
