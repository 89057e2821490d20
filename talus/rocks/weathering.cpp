#include "talus/rocks/weathering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus::rocks {
namespace {

constexpr std::int32_t kFull = 1 << 16;
constexpr std::int32_t kUndamped = 1 << 8;

// Weights of the 26 neighbors are 4, 2 and 1 across faces, edges and corners; a flat open face has
// 1, 4 and 4 of them outside.
constexpr int kCornerWeight = 1;
constexpr int kFlatExposure = 4 + 4 * 2 + 4 * 1;
constexpr int kAllWeights = 64;  // the voxel itself counts 8

constexpr double kVoxelsPerStep = 0.25;  // small enough that edges and corners round evenly

// Replaces each element by the weighted sum over its 27 neighbors with weights (1 2 1)^3: 8 for
// itself, 4, 2 and 1 across faces, edges and corners. Elements on the border of the grid come out
// meaningless.
template <class T>
void blur(const StoneGrid& grid, std::vector<T>& values, std::vector<T>& scratch) {
  scratch.resize(values.size());
  for (int axis = 0; axis < 3; ++axis) {
    const auto stride = static_cast<std::size_t>(grid.stride(axis));
    const T* const in = values.data();
    T* const out = scratch.data();
    for (std::size_t i = stride; i + stride < values.size(); ++i)
      out[i] = static_cast<T>(in[i - stride] + 2 * in[i] + in[i + stride]);
    values.swap(scratch);
  }
}

}  // namespace

Weathering::Weathering(const TileParams& params, int voxels_per_cell) {
  const double depth = params.weathering.depth * voxels_per_cell;
  steps_ = static_cast<int>(std::ceil(depth / kVoxelsPerStep));
  rate_ = steps_ > 0 ? static_cast<std::int32_t>(std::lround(kFull * depth / steps_)) : 0;
  radius_half_voxels_ = 2 * params.contacts.radius * voxels_per_cell;
  blend_half_voxels_ = 2 * params.contacts.blend * voxels_per_cell;
  // Both voxels at a contact keep all their matter: their centers are half a voxel from the face.
  radius_half_voxels_ = std::max(radius_half_voxels_, 1.0);
  blend_half_voxels_ = std::max(blend_half_voxels_, radius_half_voxels_);
}

std::span<const float> Weathering::wear(const StoneGrid& grid, std::span<const Contact> contacts) {
  start(grid, contacts);
  for (int i = 0; i < steps_; ++i) step(grid);
  smooth(grid);
  return result_;
}

void Weathering::start(const StoneGrid& grid, std::span<const Contact> contacts) {
  contact_faces_.clear();
  for (const Contact& c : contacts) contact_faces_.push_back(c.face);
  left_.assign(grid.count(), 0);
  damping_.resize(grid.count());
  is_exposed_.assign(grid.count(), 0);
  exposed_.clear();
  foreign_.assign(grid.count(), 1);
  for (const OwnVoxel& voxel : grid.own_voxels()) {
    left_[voxel.index] = kFull;
    foreign_[voxel.index] = 0;
  }
  blur(grid, foreign_, bytes_);
  exposure_ = foreign_;
  for (const OwnVoxel& voxel : grid.own_voxels())
    if (shares_face_with_outside(grid, voxel.index)) expose(voxel);
}

bool Weathering::shares_face_with_outside(const StoneGrid& grid, std::size_t i) const {
  for (int axis = 0; axis < 3; ++axis)
    if (left_[moved(i, -grid.stride(axis))] == 0 || left_[moved(i, grid.stride(axis))] == 0)
      return true;
  return false;
}

void Weathering::expose(const OwnVoxel& voxel) {
  is_exposed_[voxel.index] = 1;
  damping_[voxel.index] = damping(voxel.at);
  exposed_.push_back(voxel);
}

// omega: 0 within the contact radius, rising linearly to kUndamped at the blend radius.
std::int32_t Weathering::damping(const Int3& voxel) const {
  int nearest = std::numeric_limits<int>::max();
  for (const Int3& face : contact_faces_) {
    const Int3 d = 2 * voxel + 1 - face;
    nearest = std::min(nearest, d.x * d.x + d.y * d.y + d.z * d.z);
  }
  const double distance = std::sqrt(static_cast<double>(nearest));
  if (distance <= radius_half_voxels_) return 0;
  if (distance >= blend_half_voxels_) return kUndamped;
  return static_cast<std::int32_t>(kUndamped * (distance - radius_half_voxels_) /
                                   (blend_half_voxels_ - radius_half_voxels_));
}

void Weathering::step(const StoneGrid& grid) {
  emptied_.clear();
  std::size_t kept = 0;
  for (const OwnVoxel& voxel : exposed_) {
    const std::size_t i = voxel.index;
    const std::int64_t taken = std::int64_t{rate_} * exposure_[i] * damping_[i];
    left_[i] -= static_cast<std::int32_t>(taken / (kFlatExposure * kUndamped));
    if (left_[i] > 0) {
      exposed_[kept++] = voxel;
    } else {
      left_[i] = 0;
      emptied_.push_back(voxel);
    }
  }
  exposed_.resize(kept);
  for (const OwnVoxel& voxel : emptied_)
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const int weight = kCornerWeight << (3 - std::abs(x) - std::abs(y) - std::abs(z));
          const std::size_t j =
              moved(voxel.index, x * grid.stride(0) + y * grid.stride(1) + z * grid.stride(2));
          exposure_[j] = static_cast<std::uint8_t>(exposure_[j] + weight);
        }
  for (const OwnVoxel& voxel : emptied_)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        OwnVoxel next{voxel.at, moved(voxel.index, side * grid.stride(axis))};
        next.at[axis] += side;
        if (left_[next.index] > 0 && !is_exposed_[next.index]) expose(next);
      }
}

// Mean over the own voxels among a voxel and its neighbors. Leaving other stones out keeps flat,
// unweathered faces where they are; voxels within a contact's radius keep all their matter.
void Weathering::smooth(const StoneGrid& grid) {
  result_.assign(grid.count(), 1.0f);
  if (steps_ == 0) return;
  smoothed_ = left_;
  blur(grid, smoothed_, words_);
  for (const auto& [voxel, i] : grid.own_voxels()) {
    const bool protected_by_contact = is_exposed_[i] && damping_[i] == 0;
    if (protected_by_contact) continue;
    const std::int32_t own_weights = kAllWeights - foreign_[i];
    result_[i] = static_cast<float>(smoothed_[i]) / static_cast<float>(own_weights * kFull);
  }
}

}  // namespace talus::rocks
