#include "talus/rocks/patches.h"

#include <algorithm>
#include <cmath>
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
bool knows(const Int3& cell, const BlockType& type, const CellLayout& layout) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!layout.colored[axis]) continue;
    const int cube = floor_div(cell[axis], layout.period());
    const bool at_corner = cell[axis] == cube * layout.period();
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
    faces_.reserve(8 * block.rows.size());
  }

  void collect_within() {
    const Int3 end = block_.min + block_.size;
    for (int z = block_.min.z; z < end.z; ++z)
      for (int y = block_.min.y; y < end.y; ++y) {
        const Row row = row_of(block_, own_ids_, Int3(block_.min.x, y, z));
        for (std::size_t i = 0; i + 1 < row.runs.size(); ++i) {
          const int x = row.runs[i].end;
          add(row.runs[i].owner, row.runs[i + 1].owner, Int3(x - 1, y, z), 1, 0,
              row.nearest + (x - 1 - block_.min.x), row.nearest + (x - block_.min.x));
        }
        for (const int axis : {1, 2}) {
          Int3 next(block_.min.x, y, z);
          if (++next[axis] < end[axis])
            compare_rows(row, row_of(block_, own_ids_, next), Int3(block_.min.x, y, z), axis);
        }
      }
  }

  void collect_across(const AdjacentBlock& adjacent) {
    const std::vector<std::uint32_t> its_ids = ids_of(adjacent);
    const int axis = adjacent.axis;
    const bool above = adjacent.cube[axis] > 0;
    Int3 begin = block_.min, end = block_.min + block_.size;
    // The layer of voxels at the plane between the blocks.
    begin[axis] = above ? end[axis] - 1 : begin[axis];
    end[axis] = begin[axis] + 1;
    for (int z = begin.z; z < end.z; ++z)
      for (int y = begin.y; y < end.y; ++y) {
        const Int3 at(begin.x, y, z);
        Int3 across = at;
        across[axis] += above ? 1 : -1;
        const Row row = row_of(block_, own_ids_, at);
        const Row its =
            row_of(*adjacent.block, its_ids, across - layout_.period_voxels() * adjacent.cube);
        const Row &lower = above ? row : its, &upper = above ? its : row;
        const Int3 low = above ? at : across;
        if (axis == 0)
          add(lower.ids[lower.runs.back().owner], upper.ids[upper.runs.front().owner], low, 1, 0,
              lower.nearest + (lower.runs.back().end - 1 - lower.runs.front().begin),
              upper.nearest);
        else
          compare_rows(lower, upper, low, axis);
      }
  }

  // The faces found, by stone and neighbor.
  BlockPatches patches(const BlockType& type) {
    counting_sort(faces_, block_.candidates.size() * parties_.size(),
                  [&](const Meeting& m) { return m.own * parties_.size() + m.other; });
    std::size_t count = 0;
    for (const Meeting& m : faces_) count += m.faces.length;
    BlockPatches result;
    result.runs.reserve(faces_.size());
    result.distance_beyond.reserve(count);
    const Meeting* last = nullptr;
    for (const Meeting& m : faces_) {
      if (!last || m.own != last->own || m.other != last->other) {
        // Candidates without voxels have no patches.
        result.first.resize(m.own + 1, static_cast<std::uint32_t>(result.patches.size()));
        const Party& other = parties_[m.other];
        result.patches.push_back(
            {.cell = other.cell,
             .seed = other.seed,
             .known_to_both = knows(other.cell, type, layout_),
             .first_run = static_cast<std::uint32_t>(result.runs.size()),
             .first_face = static_cast<std::uint32_t>(result.distance_beyond.size())});
      }
      last = &m;
      result.runs.push_back(m.faces);
      const std::int64_t length = m.faces.length;
      append_distances(m, result.distance_beyond);
      Patch& patch = result.patches.back();
      patch.end_run = static_cast<std::uint32_t>(result.runs.size());
      patch.faces += length;
      patch.sum += length * glm::i64vec3(m.faces.middle());
      patch.sum.x += length * (length - 1);
    }
    result.first.resize(block_.candidates.size() + 1,
                        static_cast<std::uint32_t>(result.patches.size()));
    return result;
  }

 private:
  struct Meeting {
    std::uint32_t own, other;  // parties
    FaceRun faces;
    const float* nearest_beyond;
  };
  struct Row {
    std::span<const RowRun> runs;
    std::span<const std::uint32_t> ids;  // party for each owner
    const float* nearest;                // of its voxels
  };

  // Half of what a stone's distance exceeds the owner's across its faces, negative, at least -1.
  void append_distances(const Meeting& m, std::vector<float>& out) const {
    const Int3 beyond = m.faces.beyond();
    const Candidate& own = block_.candidates[m.own];
    const float *const x = own.centers[0] + beyond.x, *const along_x = own.penalties[0] + beyond.x;
    const float y = own.centers[1][beyond.y], z = own.centers[2][beyond.z];
    const float row_penalty = std::max(own.penalties[1][beyond.y], own.penalties[2][beyond.z]);
    out.resize(out.size() + m.faces.length);
    float* const to = out.data() + out.size() - m.faces.length;
    for (int k = 0; k < m.faces.length; ++k) {
      const float penalty = std::max(along_x[k], row_penalty);
      const float distance = std::sqrt(own.form->distance(x[k], y, z) * penalty);
      to[k] = std::max(0.5f * (m.nearest_beyond[k] - distance), -1.0f);
    }
  }

  static Row row_of(const Block& block, std::span<const std::uint32_t> ids, const Int3& voxel) {
    return {block.row(voxel.y, voxel.z), ids,
            &block.nearest[block.index(Int3(block.min.x, voxel.y, voxel.z))]};
  }

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

  // Adds the faces between two rows; `low` is the first voxel of the lower one.
  void compare_rows(const Row& lower, const Row& upper, const Int3& low, int axis) {
    for (auto l = lower.runs.begin(), u = upper.runs.begin(); l != lower.runs.end();) {
      const int begin = std::max(l->begin, u->begin), end = std::min(l->end, u->end);
      const int from = begin - low.x;
      add(lower.ids[l->owner], upper.ids[u->owner], Int3(begin, low.y, low.z), end - begin, axis,
          lower.nearest + from, upper.nearest + from);
      const bool lower_ends = l->end == end, upper_ends = u->end == end;
      l += lower_ends;
      u += upper_ends;
    }
  }

  // Adds the upper faces of voxels from `low` on, seen from either side.
  void add(std::uint32_t lower, std::uint32_t upper, const Int3& low, int length, int axis,
           const float* lower_nearest, const float* upper_nearest) {
    if (lower == upper) return;
    Int3 middle = 2 * low + 1;
    ++middle[axis];
    const auto faces = [&](bool upwards) {
      return FaceRun{.x = static_cast<std::int16_t>(middle.x),
                     .y = static_cast<std::int16_t>(middle.y),
                     .z = static_cast<std::int16_t>(middle.z),
                     .length = static_cast<std::uint16_t>(length & 0x1fff),
                     .axis = static_cast<std::uint16_t>(axis & 3),
                     .upwards = upwards};
    };
    const std::size_t candidates = block_.candidates.size();
    if (lower < candidates) faces_.push_back({lower, upper, faces(true), upper_nearest});
    if (upper < candidates) faces_.push_back({upper, lower, faces(false), lower_nearest});
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
