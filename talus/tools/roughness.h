// Noise that makes smooth forms rough.
#pragma once

#include <algorithm>
#include <cmath>
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

  Vec3 shift(const Vec3& p) const { return most_ * direction(p); }

  // Where a place is carried by shifts so small, one after the other, that no two places meet and
  // none is left out: a surface that is carried does not fold over itself.
  Vec3 carried(Vec3 p) const {
    const double steps = std::max(1.0, std::ceil(most_ / (kUnfoldedShare * size_)));
    for (double i = 0; i < steps; ++i) p += most_ / steps * direction(p);
    return p;
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

  // Shifts of this share of the size leave neighbors in their order: the noise's slope was nowhere
  // above 4.2 / size in millions of places.
  static constexpr double kUnfoldedShare = 0.125;

  // At most of length 1.
  Vec3 direction(const Vec3& p) const {
    const Vec3 noise = fractal(noise_, p / size_, kFractal);
    return noise / std::max(1.0, glm::length(noise));
  }

  GradientNoise noise_;
  double most_;
  double size_;
};

}  // namespace talus
