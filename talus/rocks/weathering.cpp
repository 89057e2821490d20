#include "talus/rocks/weathering.h"

#include <algorithm>
#include <cmath>

namespace talus::rocks {
namespace {

constexpr std::int32_t kFull = 1 << 16;
constexpr std::int32_t kUndamped = 1 << 8;

// Weights of the 26 neighbors are 4, 2 and 1 across faces, edges and corners; a flat open face has
// 1, 4 and 4 of them outside.
constexpr std::int32_t kFlatExposure = 4 + 4 * 2 + 4 * 1;
constexpr int kAllWeights = 64;  // the voxel itself counts 8

constexpr double kVoxelsPerStep = 0.25;  // small enough that edges and corners round evenly

// Replaces each element by the weighted sum over its 27 neighbors with weights (1 2 1)^3: 8 for
// itself, 4, 2 and 1 across faces, edges and corners. Elements on the border of the grid come out
// meaningless.
template <class T>
void blur(const StoneGrid& grid, std::vector<T>& values, std::vector<T>& scratch) {
  scratch.resize(values.size());
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t stride = grid.stride(axis), end = values.size() - stride;
    const T* const in = values.data();
    T* const out = scratch.data();
    for (std::size_t i = stride; i < end; ++i)
      out[i] = static_cast<T>(in[i - stride] + 2 * in[i] + in[i + stride]);
    values.swap(scratch);
  }
}

}  // namespace

Weathering::Weathering(const TileParams& params, int voxels_per_cell) {
  const double depth = params.weathering.depth * voxels_per_cell;
  steps_ = static_cast<int>(std::ceil(depth / kVoxelsPerStep));
  rate_ = steps_ > 0 ? static_cast<std::int32_t>(std::lround(kFull * depth / steps_)) : 0;
  // Both voxels at a contact keep all their matter: their centers are half a voxel from the face.
  const double radius = std::max(2 * params.contacts.radius * voxels_per_cell, 1.0);
  const double blend = std::max(2 * params.contacts.blend * voxels_per_cell, radius);
  reach_half_voxels_ = static_cast<int>(std::ceil(blend));
  // 0 within the contact radius, rising linearly to kUndamped at the blend radius.
  for (int squared = 0; squared <= radius * radius || squared < blend * blend; ++squared) {
    const double distance = std::sqrt(static_cast<double>(squared));
    const double share = distance <= radius ? 0 : (distance - radius) / (blend - radius);
    damping_near_.push_back(static_cast<std::int32_t>(kUndamped * share));
  }
}

std::span<const float> Weathering::wear(const StoneGrid& grid, std::span<const Contact> contacts) {
  result_.assign(grid.count(), 1.0f);
  if (steps_ == 0) return result_;
  start(grid, contacts);
  for (int i = 0; i < steps_; ++i) {
    expose(grid);
    step(grid);
  }
  expose(grid);
  smooth(grid);
  return result_;
}

void Weathering::start(const StoneGrid& grid, std::span<const Contact> contacts) {
  const std::size_t count = grid.count();
  left_.resize(count);
  outside_.resize(count);
  const std::uint8_t* const own = grid.own().data();
  std::int32_t* const left = left_.data();
  std::uint8_t* const outside = outside_.data();
  for (std::size_t i = 0; i < count; ++i) left[i] = kFull * own[i];
  for (std::size_t i = 0; i < count; ++i) outside[i] = !own[i];
  foreign_ = outside_;
  blur(grid, foreign_, bytes_);
  damping_.assign(count, kUndamped);
  for (const Contact& contact : contacts) damp(grid, contact.face);
}

// Lowers the damping of the voxels around a contact.
void Weathering::damp(const StoneGrid& grid, const Int3& face) {
  const auto limit = static_cast<int>(damping_near_.size());
  // From the contact to the center of the grid's first voxel, in half voxels; the voxels in reach.
  const Int3 first = 2 * grid.min() + 1 - face;
  const Int3 begin = glm::max((-reach_half_voxels_ - first) / 2, Int3(0));
  const Int3 end = glm::min((reach_half_voxels_ - first) / 2 + 1, grid.size());
  for (int z = begin.z; z < end.z; ++z)
    for (int y = begin.y; y < end.y; ++y) {
      const int dy = first.y + 2 * y, dz = first.z + 2 * z, across = dy * dy + dz * dz;
      if (across >= limit) continue;
      std::int32_t* const row = &damping_[grid.index(grid.min() + Int3(0, y, z))];
      for (int x = begin.x; x < end.x; ++x) {
        const int dx = first.x + 2 * x, squared = across + dx * dx;
        if (squared < limit)
          row[x] = std::min(row[x], damping_near_[static_cast<std::size_t>(squared)]);
      }
    }
}

// Finds which voxels are exposed and how much.
void Weathering::expose(const StoneGrid& grid) {
  exposure_ = outside_;
  blur(grid, exposure_, bytes_);
  at_surface_.resize(grid.count());
  const std::size_t dy = grid.stride(1), dz = grid.stride(2), end = grid.count() - dz;
  const std::uint8_t* const out = outside_.data();
  std::uint8_t* const surface = at_surface_.data();
  for (std::size_t i = dz; i < end; ++i)
    surface[i] = out[i - 1] | out[i + 1] | out[i - dy] | out[i + dy] | out[i - dz] | out[i + dz];
}

void Weathering::step(const StoneGrid& grid) {
  const std::uint8_t *const exposure = exposure_.data(), *const at_surface = at_surface_.data();
  const std::int32_t* const damping = damping_.data();
  std::int32_t* const left = left_.data();
  const std::size_t begin = grid.stride(2), end = grid.count() - begin;
  const auto rate = static_cast<std::uint32_t>(rate_);
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t taken = rate * exposure[i] * static_cast<std::uint32_t>(damping[i]) /
                                static_cast<std::uint32_t>(kFlatExposure * kUndamped);
    left[i] = std::max(left[i] - at_surface[i] * static_cast<std::int32_t>(taken), 0);
  }
  std::uint8_t* const outside = outside_.data();
  for (std::size_t i = begin; i < end; ++i) outside[i] = left[i] == 0;
}

// Mean over the own voxels among a voxel and its neighbors. Leaving other stones out keeps flat,
// unweathered faces where they are; voxels within a contact's radius keep all their matter.
void Weathering::smooth(const StoneGrid& grid) {
  smoothed_ = left_;
  blur(grid, smoothed_, words_);
  const std::uint8_t *const foreign = foreign_.data(), *const at_surface = at_surface_.data();
  const std::int32_t *const damping = damping_.data(), *const smoothed = smoothed_.data();
  float* const result = result_.data();
  const std::size_t begin = grid.stride(2), end = grid.count() - begin;
  for (std::size_t i = begin; i < end; ++i) {
    const float own_weights = static_cast<float>((kAllWeights - foreign[i]) * kFull);
    const bool protected_by_contact = (at_surface[i] != 0) & (damping[i] == 0);
    const float mean = static_cast<float>(smoothed[i]) / own_weights;
    result[i] = protected_by_contact ? 1.0f : mean;
  }
}

}  // namespace talus::rocks
