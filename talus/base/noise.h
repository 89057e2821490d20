// Noise that repeats seamlessly, for textures.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/base/hash.h"

namespace talus {

// Gradient noise on a plane that repeats every `period` units along both axes ([Perlin2002]):
// zero at integer points, within [-1, 1], smooth. Only additions, multiplications and table
// look-ups, so that every machine gets the same bits.
class PeriodicNoise {
 public:
  PeriodicNoise(std::uint64_t seed, int period) : period_(period) {
    corners_.reserve(static_cast<std::size_t>(period) * static_cast<std::size_t>(period));
    for (int y = 0; y < period; ++y)
      for (int x = 0; x < period; ++x)
        corners_.push_back(
            static_cast<std::uint8_t>(hash(seed, Purpose::texture, period, x, y) >> 61));
  }

  float operator()(float x, float y) const {
    const int ix = floor_of(x), iy = floor_of(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const float u = fade(fx), v = fade(fy);
    const float low = mix(slope(ix, iy, fx, fy), slope(ix + 1, iy, fx - 1, fy), u);
    const float high = mix(slope(ix, iy + 1, fx, fy - 1), slope(ix + 1, iy + 1, fx - 1, fy - 1), u);
    return mix(low, high, v);
  }

 private:
  static int floor_of(float x) {
    const int i = static_cast<int>(x);
    return static_cast<float>(i) > x ? i - 1 : i;
  }
  static float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
  static float mix(float a, float b, float t) { return a + t * (b - a); }

  // Height at (dx, dy) from a corner on the plane through it; one of eight directions.
  float slope(int x, int y, float dx, float dy) const {
    const auto wrapped = [&](int i) {
      return static_cast<std::size_t>((i % period_ + period_) % period_);
    };
    constexpr float kDiagonal = 0.70710678f;
    constexpr float kX[8] = {1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal, 0, kDiagonal};
    constexpr float kY[8] = {0, kDiagonal, 1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal};
    const std::uint8_t d = corners_[wrapped(y) * static_cast<std::size_t>(period_) + wrapped(x)];
    return kX[d] * dx + kY[d] * dy;
  }

  int period_;
  std::vector<std::uint8_t> corners_;  // direction of the slope at each lattice point
};

}  // namespace talus
