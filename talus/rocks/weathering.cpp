#include "talus/rocks/weathering.h"

#include <algorithm>
#include <cmath>

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

// Steps of rounding that make a stone of one cell a pebble, for each squared voxel of its cell's
// edge: a step moves the surface by its curvature.
constexpr double kRoundingSteps = 0.025;

// The share of depth that rounding takes over at its most: faces that recede around a contact would
// leave a pebble with a knob there.
constexpr double kRoundInsteadOfDepth = 0.75;

}  // namespace

Weathering::Weathering(const TileParams& params, int voxels_per_cell)
    : depth_(params.weathering.depth * (1 - kRoundInsteadOfDepth * params.weathering.roundness) *
             voxels_per_cell),
      rounding_(params.weathering.roundness * kRoundingSteps * voxels_per_cell * voxels_per_cell),
      damping_(params, voxels_per_cell),
      variation_(params.weathering.variation) {}

std::span<const float> Weathering::wear(const StoneGrid& grid, std::span<const Contact> contacts) {
  result_.assign(grid.count(), 1.0f);
  if (depth_ == 0 && rounding_ == 0) return result_;
  start(grid, contacts);
  erode(grid);
  round(grid);
  find_surface(grid);
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
  damping_.find_shares(grid, contacts, shares_);
}

void Weathering::erode(const StoneGrid& grid) {
  const double depth = depth_ * grid.size_scale();
  const auto steps =
      static_cast<int>(std::ceil(depth * (1 + variation_.amount()) / kVoxelsPerStep));
  if (steps == 0) return;
  set_rates(grid,
            static_cast<unsigned>((1 << kRateShift) * kFull * depth / (steps * kFlatExposure)));
  exposure_ = foreign_;  // at first nothing else is outside
  for (int i = 0; i < steps; ++i) {
    if (i > 0) find_exposure(grid);
    find_surface(grid);
    step(grid);
  }
}

void Weathering::set_rates(const StoneGrid& grid, unsigned rate) {
  const std::size_t count = grid.count();
  rates_.resize(count);
  const std::uint16_t* const share = shares_.data();
  std::uint16_t* const rates = rates_.data();
  for (std::size_t i = 0; i < count; ++i)
    rates[i] = static_cast<std::uint16_t>(rate * share[i] / Damping::kFullShare);
  if (variation_.amount() == 0) return;
  const std::uint16_t* const factor = variation_.factors(grid).data();
  for (std::size_t i = 0; i < count; ++i)
    rates[i] = static_cast<std::uint16_t>(unsigned{rates[i]} * factor[i] / Variation::kOne);
}

void Weathering::find_exposure(const StoneGrid& grid) {
  exposure_ = outside_;
  blur(grid.size(), exposure_, bytes_);
}

void Weathering::find_surface(const StoneGrid& grid) {
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

void Weathering::round(const StoneGrid& grid) {
  if (rounding_ == 0) return;
  constexpr int kWhole = 256;
  const double steps = rounding_ * grid.size_scale() * grid.size_scale();
  for (int left = static_cast<int>(std::lround(steps * kWhole)); left > 0; left -= kWhole)
    round_step(grid, std::min(left, kWhole));
  for (std::size_t i = 0; i < grid.count(); ++i) outside_[i] = left_[i] == 0;
}

// One step, or `weight` 256ths of it.
void Weathering::round_step(const StoneGrid& grid, int weight) {
  const std::size_t count = grid.count();
  smoothed_.resize(count);
  std::uint16_t* const left = left_.data();
  for (std::size_t i = 0; i < count; ++i)
    smoothed_[i] = static_cast<std::uint16_t>(left[i] / (kFull / kSample));
  blur(grid.size(), smoothed_, words_);
  for (std::size_t i = 0; i < count; ++i)
    smoothed_[i] = static_cast<std::uint16_t>(smoothed_[i] / kAllWeights);
  blur(grid.size(), smoothed_, words_);

  // Sharpened about a half by what the two blurs leave of a step, so that flat surfaces stay.
  constexpr int kHalf = kAllWeights * kSample / 2, kToFull = kAllWeights * kSample / kFull;
  const std::uint16_t *const blurred = smoothed_.data(), *const share = shares_.data();
  const std::size_t begin = grid.stride(2), end = count - begin;
  for (std::size_t i = begin; i < end; ++i) {
    const int sharp = std::clamp(kHalf + 8 * (blurred[i] - kHalf) / 3, 0, 2 * kHalf) / kToFull;
    const int loss = std::max(left[i] - sharp, 0) * weight / 256;
    left[i] = static_cast<std::uint16_t>(left[i] - loss * share[i] / Damping::kFullShare);
  }
}

// Mean over the own voxels among a voxel and its neighbors. Leaving other stones out keeps flat,
// unweathered faces where they are; voxels within a contact's radius keep all their matter.
void Weathering::smooth(const StoneGrid& grid) {
  const std::size_t begin = grid.stride(2), count = grid.count(), end = count - begin;
  smoothed_.resize(count);
  const std::uint16_t *const left = left_.data(), *const share = shares_.data();
  std::uint16_t* const smoothed = smoothed_.data();
  for (std::size_t i = 0; i < count; ++i)
    smoothed[i] = static_cast<std::uint16_t>(left[i] / (kFull / kSample));
  blur(grid.size(), smoothed_, words_);

  const std::uint8_t *const foreign = foreign_.data(), *const at_surface = at_surface_.data();
  std::uint16_t* const sum = smoothed_.data();
  std::uint16_t* const full = words_.data();
  for (std::size_t i = begin; i < end; ++i) {
    full[i] = static_cast<std::uint16_t>((kAllWeights - foreign[i]) * kSample);
    const std::uint16_t near_contact = at_surface[i] & (share[i] == 0);
    sum[i] = near_contact ? full[i] : sum[i];
  }
  float* const result = result_.data();
  for (std::size_t i = begin; i < end; ++i)
    result[i] = static_cast<float>(sum[i]) / static_cast<float>(full[i]);
}

}  // namespace talus::rocks
