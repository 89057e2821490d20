#include "talus/rocks/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "talus/base/lanes.h"

namespace talus::rocks {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Rows that are labeled together, kLanes voxels of each.
constexpr int kRows = 4;

// Boxes of voxels that are labeled with candidates of their own.
constexpr Int3 kBoxSize(kLanes, 4, 4);

// kLanes candidates along rows of voxels: the distance of each is ((xx dx + linear) dx + constant)
// times its penalty, dx = x - position.
struct RowForms {
  Floats x, y, z, xx, yy, zz, xy, xz, yz;
  Floats center_y, center_z;    // coordinates of voxel 0, relative to the candidates' cells
  Floats xz_dz, yz_dz, zz_dz2;  // of the rows' layer
  std::array<Floats, kRows> linear, constant;

  void set(std::size_t lane, const Candidate& c) {
    const Seed& s = *c.form;
    x[lane] = s.position.x, y[lane] = s.position.y, z[lane] = s.position.z;
    xx[lane] = s.xx, yy[lane] = s.yy, zz[lane] = s.zz;
    xy[lane] = s.xy, xz[lane] = s.xz, yz[lane] = s.yz;
    center_y[lane] = c.centers[1][0], center_z[lane] = c.centers[2][0];
  }
  void set_layer(int voxel) {
    const Floats dz = center_z + static_cast<float>(voxel) - z;
    xz_dz = xz * dz;
    yz_dz = yz * dz;
    zz_dz2 = zz * (dz * dz);
  }
  void set_row(std::size_t row, int voxel) {
    const Floats dy = center_y + static_cast<float>(voxel) - y;
    linear[row] = xy * dy + xz_dz;
    constant[row] = (yy * dy + yz_dz) * dy + zz_dz2;
  }
};

class Labeler {
 public:
  explicit Labeler(Block& block) : block_(block) {
    for (const Candidate& c : block.candidates) {
      steepness_.push_back(c.form->steepness());
      corners_.emplace_back(c.centers[0][0], c.centers[1][0], c.centers[2][0]);
    }
    const std::size_t count = block.voxel_count() + kLanes;
    nearest_.resize(count);
    block_.owners.resize(count);
    block_.runners_up.resize(count);
    block_.clearance.resize(count);
  }

  void label() {
    near_.resize(block_.candidates.size());
    std::iota(near_.begin(), near_.end(), 0u);
    divide({block_.min, block_.min + block_.size - 1}, 0);

    // So far the clearance holds the second least D.
    const float* const nearest = nearest_.data();
    float* const clearance = block_.clearance.data();
    for (std::size_t i = 0; i < block_.voxel_count(); ++i)
      clearance[i] = std::min(0.5f * (std::sqrt(clearance[i]) - std::sqrt(nearest[i])), 1.0f);
    find_extents();
  }

 private:
  // Halves a box until it is small, leaving out candidates that matter nowhere in it. Those to look
  // at are the entries of `near_` from `first` on.
  void divide(const VoxelBox& box, std::size_t first) {
    constexpr std::size_t kMany = 48;  // for a large box to be worth the effort
    const Int3 size = box.max - box.min + 1;
    const Int3 parts = (size + kBoxSize - 1) / kBoxSize;
    const int axis = parts.x >= std::max(parts.y, parts.z) ? 0 : parts.y >= parts.z ? 1 : 2;
    const std::size_t end = near_.size();
    if (parts[axis] == 1 || end - first > kMany) {
      append_near(box, first, end);
      first = end;
    }
    if (parts[axis] == 1) {
      compete_in_box(box, std::span(near_).subspan(first));
    } else {
      VoxelBox lower = box, upper = box;
      upper.min[axis] += parts[axis] / 2 * kBoxSize[axis];
      lower.max[axis] = upper.min[axis] - 1;
      divide(lower, first);
      divide(upper, first);
    }
    near_.resize(end);
  }

  // Appends those of the entries `first` to `end` of `near_` that matter in a box: that may own a
  // voxel, or be second so close that the clearance is less than 1. The root of a distance changes
  // by at most its steepness from one voxel to the next.
  void append_near(const VoxelBox& box, std::size_t first, std::size_t end) {
    constexpr float kMatters = 2 + 0.01f;  // some for rounding
    const Vec3f middle = 0.5f * Vec3f(box.min + box.max);
    const float radius = 0.5f * glm::length(Vec3f(box.max - box.min));
    float most = kInfinity;  // that the least distance can be
    roots_.clear();
    for (std::size_t k = first; k < end; ++k) {
      const std::uint32_t i = near_[k];
      const Vec3f at = corners_[i] + middle;
      const float root = std::sqrt(block_.candidates[i].form->distance(at.x, at.y, at.z));
      const float farthest = root + radius * steepness_[i];
      if (farthest < most) most = std::min(most, farthest * std::sqrt(largest_penalty(i, box)));
      roots_.push_back(root);
    }
    for (std::size_t k = first; k < end; ++k) {
      const std::uint32_t i = near_[k];
      if (roots_[k - first] - radius * steepness_[i] < most + kMatters) near_.push_back(i);
    }
  }

  // Along an axis the penalty falls, then rises, so that it is largest at one of the ends.
  float largest_penalty(std::uint32_t candidate, const VoxelBox& box) const {
    float penalty = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const float* const along =
          block_.candidates[candidate].penalties[static_cast<std::size_t>(axis)];
      penalty = std::max({penalty, along[box.min[axis]], along[box.max[axis]]});
    }
    return penalty;
  }

  void compete_in_box(const VoxelBox& box, std::span<const std::uint32_t> candidates) {
    forms_.resize((candidates.size() + kLanes - 1) / kLanes);
    for (std::size_t k = 0; k < candidates.size(); ++k)
      forms_[k / kLanes].set(k % kLanes, block_.candidates[candidates[k]]);
    for (int z = box.min.z; z <= box.max.z; ++z) {
      for (RowForms& form : forms_) form.set_layer(z);
      for (int y = box.min.y; y <= box.max.y; y += kRows) {
        // Where the box has no more rows, its last one is labeled again.
        std::array<int, kRows> rows;
        for (std::size_t r = 0; r < kRows; ++r) {
          rows[r] = std::min(y + static_cast<int>(r), box.max.y);
          for (RowForms& form : forms_) form.set_row(r, rows[r]);
        }
        compete(candidates, rows, z, box);
      }
    }
  }

  // The rule itself.
  void compete(std::span<const std::uint32_t> candidates, const std::array<int, kRows>& rows, int z,
               const VoxelBox& box) {
    Floats nearest[kRows], second[kRows];
    Indices owner[kRows], runner_up[kRows];
    for (std::size_t r = 0; r < kRows; ++r) {
      nearest[r] = second[r] = Floats{} + kInfinity;
      owner[r] = runner_up[r] = Indices{};
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const RowForms& forms = forms_[k / kLanes];
      const std::size_t lane = k % kLanes;
      const Candidate& candidate = block_.candidates[candidates[k]];
      const Floats dx = load<Floats>(candidate.centers[0] + box.min.x) - forms.x[lane];
      const Floats along_x = load<Floats>(candidate.penalties[0] + box.min.x);
      const Indices index = Indices{} + static_cast<std::int32_t>(candidates[k]);
      for (std::size_t r = 0; r < kRows; ++r) {
        const Floats row_penalty =
            std::max(candidate.penalties[1][rows[r]], candidate.penalties[2][z]) - Floats{};
        const Floats penalty = along_x > row_penalty ? along_x : row_penalty;
        const Floats d =
            ((forms.xx[lane] * dx + forms.linear[r][lane]) * dx + forms.constant[r][lane]) *
            penalty;
        const Indices first = d < nearest[r];
        runner_up[r] = first ? owner[r] : d < second[r] ? index : runner_up[r];
        owner[r] = first ? index : owner[r];
        const Floats farther = first ? nearest[r] : d;
        second[r] = farther < second[r] ? farther : second[r];
        nearest[r] = first ? d : nearest[r];
      }
    }
    // What lies beyond the box is not kept.
    const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(box.max.x - box.min.x + 1);
    for (std::size_t r = 0; r < kRows; ++r) {
      const std::size_t at = block_.index(Int3(box.min.x, rows[r], z));
      std::memcpy(&nearest_[at], &nearest[r], bytes);
      std::memcpy(&block_.clearance[at], &second[r], bytes);
      std::memcpy(&block_.owners[at], &owner[r], bytes);
      std::memcpy(&block_.runners_up[at], &runner_up[r], bytes);
    }
  }

  void find_extents() {
    block_.extent.resize(block_.candidates.size());
    block_.for_each_run([&](const Int3& first, int length, std::uint32_t owner) {
      block_.extent[owner].include({first, first + Int3(length - 1, 0, 0)});
    });
  }

  Block& block_;
  std::vector<float> steepness_;  // by candidate
  std::vector<RowForms> forms_;   // of a box
  std::vector<Vec3f> corners_;    // by candidate: from its cell to the center of voxel 0
  std::vector<std::uint32_t> near_;
  std::vector<float> roots_;
  std::vector<float> nearest_;  // by voxel: the least D
};

}  // namespace

void label(Block& block) { Labeler(block).label(); }

}  // namespace talus::rocks
