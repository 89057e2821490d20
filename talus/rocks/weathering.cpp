#include "talus/rocks/weathering.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/mesh/grid_blur.h"

namespace talus::rocks {
namespace {

// Amounts fit 16 bits: sums of 64 samples of up to kSample, products of an exposure and a rate.
constexpr int kSample = 1023;
constexpr int kFull = 16 * kSample;

// Weights of the 26 neighbors are 4, 2 and 1 across faces, edges and corners; a flat open face has
// 1, 4 and 4 of them outside.
constexpr int kFlatExposure = 4 + 4 * 2 + 4 * 1;
constexpr int kAllWeights = 64;  // the voxel itself counts 8
constexpr int kRateShift = 2;    // rates are kept in quarters

constexpr double kVoxelsPerStep = 0.25;  // small enough that edges and corners round evenly

}  // namespace

Weathering::Weathering(const TileParams& params, int voxels_per_cell) {
  const double depth = params.weathering.depth * voxels_per_cell;
  steps_ = static_cast<int>(std::ceil(depth / kVoxelsPerStep));
  const double rate = steps_ > 0 ? (1 << kRateShift) * kFull * depth / (steps_ * kFlatExposure) : 0;
  rate_ = static_cast<std::uint16_t>(rate);
  // Both voxels at a contact keep all their matter: their centers are half a voxel from the face.
  const double radius = std::max(2 * params.contacts.radius * voxels_per_cell, 1.0);
  const double blend = std::max(2 * params.contacts.blend * voxels_per_cell, radius);
  for (int axis = 0; axis < 3; ++axis)
    near_contact_[static_cast<std::size_t>(axis)] = make_stencil(axis, rate, radius, blend);
}

// 0 within the contact radius, rising linearly to the full rate at the blend radius; in half
// voxels.
Weathering::Stencil Weathering::make_stencil(int axis, double rate, double radius,
                                             double blend) const {
  const int reach = static_cast<int>(std::ceil(blend)) / 2;  // in voxels
  Stencil stencil{.first = Int3(-reach), .size = Int3(2 * reach + 1)};
  ++stencil.size[axis];
  for (int z = 0; z < stencil.size.z; ++z)
    for (int y = 0; y < stencil.size.y; ++y)
      for (int x = 0; x < stencil.size.x; ++x) {
        Vec3 from_face = 2.0 * Vec3(stencil.first + Int3(x, y, z));
        from_face[axis] -= 1;
        const double distance = glm::length(from_face);
        const double share = distance <= radius  ? 0
                             : distance >= blend ? 1
                                                 : (distance - radius) / (blend - radius);
        stencil.rates.push_back(static_cast<std::uint16_t>(rate * share));
      }
  return stencil;
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
  std::uint16_t* const left = left_.data();
  std::uint8_t* const outside = outside_.data();
  for (std::size_t i = 0; i < count; ++i) left[i] = static_cast<std::uint16_t>(kFull * own[i]);
  for (std::size_t i = 0; i < count; ++i) outside[i] = !own[i];
  foreign_ = outside_;
  blur(grid.size(), foreign_, bytes_);
  rates_.assign(count, rate_);
  for (const Contact& contact : contacts) damp(grid, contact.face);
}

// Lowers the rates of the voxels around a contact.
void Weathering::damp(const StoneGrid& grid, const Int3& face) {
  // Across its axis the middle of a face has an even coordinate.
  const std::size_t axis = face.x % 2 == 0 ? 0 : face.y % 2 == 0 ? 1 : 2;
  const Stencil& stencil = near_contact_[axis];
  Int3 lower = face - 1;
  --lower[static_cast<int>(axis)];
  const Int3 at = lower / 2 + stencil.first - grid.min();  // of the stencil in the grid
  const Int3 begin = glm::max(-at, 0), end = glm::min(stencil.size, grid.size() - at);
  for (int z = begin.z; z < end.z; ++z)
    for (int y = begin.y; y < end.y; ++y) {
      std::uint16_t* const row = &rates_[grid.index(grid.min() + at + Int3(begin.x, y, z))];
      const std::uint16_t* const limit = &stencil.rates[static_cast<std::size_t>(
          begin.x + stencil.size.x * (y + stencil.size.y * z))];
      for (int x = 0; x < end.x - begin.x; ++x) row[x] = std::min(row[x], limit[x]);
    }
}

// Finds which voxels are exposed and how much.
void Weathering::expose(const StoneGrid& grid) {
  exposure_ = outside_;
  blur(grid.size(), exposure_, bytes_);
  at_surface_.resize(grid.count());
  const std::size_t dy = grid.stride(1), dz = grid.stride(2), end = grid.count() - dz;
  const std::uint8_t* const out = outside_.data();
  std::uint8_t* const surface = at_surface_.data();
  for (std::size_t i = dz; i < end; ++i)
    surface[i] = out[i - 1] | out[i + 1] | out[i - dy] | out[i + dy] | out[i - dz] | out[i + dz];
}

void Weathering::step(const StoneGrid& grid) {
  const std::uint8_t *const exposure = exposure_.data(), *const at_surface = at_surface_.data();
  const std::uint16_t* const rate = rates_.data();
  std::uint16_t* const left = left_.data();
  const std::size_t begin = grid.stride(2), end = grid.count() - begin;
  for (std::size_t i = begin; i < end; ++i) {
    const auto product = static_cast<std::uint16_t>(at_surface[i] * exposure[i] * rate[i]);
    const auto taken = static_cast<std::uint16_t>(product >> kRateShift);
    left[i] = static_cast<std::uint16_t>(left[i] - std::min(left[i], taken));
  }
  std::uint8_t* const outside = outside_.data();
  for (std::size_t i = begin; i < end; ++i) outside[i] = left[i] == 0;
}

// Mean over the own voxels among a voxel and its neighbors. Leaving other stones out keeps flat,
// unweathered faces where they are; voxels within a contact's radius keep all their matter.
void Weathering::smooth(const StoneGrid& grid) {
  const std::size_t begin = grid.stride(2), count = grid.count(), end = count - begin;
  smoothed_.resize(count);
  const std::uint16_t *const left = left_.data(), *const rate = rates_.data();
  std::uint16_t* const smoothed = smoothed_.data();
  for (std::size_t i = 0; i < count; ++i)
    smoothed[i] = static_cast<std::uint16_t>(left[i] / (kFull / kSample));
  blur(grid.size(), smoothed_, words_);

  const std::uint8_t *const foreign = foreign_.data(), *const at_surface = at_surface_.data();
  std::uint16_t* const sum = smoothed_.data();
  std::uint16_t* const full = words_.data();
  for (std::size_t i = begin; i < end; ++i) {
    full[i] = static_cast<std::uint16_t>((kAllWeights - foreign[i]) * kSample);
    const std::uint16_t near_contact = at_surface[i] & (rate[i] == 0);
    sum[i] = near_contact ? full[i] : sum[i];
  }
  float* const result = result_.data();
  for (std::size_t i = begin; i < end; ++i)
    result[i] = static_cast<float>(sum[i]) / static_cast<float>(full[i]);
}

}  // namespace talus::rocks
