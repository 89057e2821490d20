// Noise that makes smooth forms rough.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>

#include "talus/field/gradient_noise.h"

namespace talus {

// Shifts places in space, at most by a length, smoothly and without a preferred direction; bumps of
// four sizes, the largest given.
class Roughness {
 public:
  Roughness(double most, double size, std::uint64_t seed)
      : noise_(seed), most_(most), size_(size) {}

  Vec3 shift(const Vec3& p) const {
    const Vec3 noise = fractal(noise_, p / size_, kFractal);
    return most_ / std::max(1.0, glm::length(noise)) * noise;
  }

  double most() const { return most_; }
  double finest_bump() const { return kFinestShare * size_; }

 private:
  static constexpr FractalParams kFractal{.octaves = 4};
  static constexpr double kFinestShare = [] {
    double share = 1;
    for (int octave = 1; octave < kFractal.octaves; ++octave) share /= kFractal.lacunarity;
    return share;
  }();

  GradientNoise noise_;
  double most_;
  double size_;
};

}  // namespace talus
