#include "talus/field/gradient_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

TEST(GradientNoise, IsZeroAtLatticePoints) {
  const GradientNoise noise(7);
  for (int i = -20; i < 20; ++i) {
    EXPECT_EQ(noise.at(Vec2(i, 3 * i - 5)), 0);
    EXPECT_EQ(noise.at(Vec3(i, 3 * i - 5, -2 * i)), Vec3(0));
  }
}

TEST(GradientNoise, StaysWithinOneAndComesNearIt) {
  const GradientNoise noise(3);
  double largest = 0, largest_in_space = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Vec2 p(0.137 * i, 0.0731 * i);
    largest = std::max(largest, std::abs(noise.at(p)));
    const Vec3 n = noise.at(Vec3(p, 0.0397 * i));
    for (int axis = 0; axis < 3; ++axis)
      largest_in_space = std::max(largest_in_space, std::abs(n[axis]));
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(largest, 0.85);
  EXPECT_LE(largest_in_space, 1);
  EXPECT_GT(largest_in_space, 0.7);
}

// Values and slopes agree on both sides of a lattice line.
TEST(GradientNoise, IsSmoothAcrossLatticeLines) {
  const GradientNoise noise(11);
  constexpr double kH = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const double y = 0.173 * i;
    const double left = noise.at(Vec2(5 - kH, y)), middle = noise.at(Vec2(5, y)),
                 right = noise.at(Vec2(5 + kH, y));
    EXPECT_NEAR((middle - left) / kH, (right - middle) / kH, 2e-3);
  }
}

TEST(GradientNoise, SeedsDiffer) {
  EXPECT_NE(GradientNoise(1).at(Vec2(0.4, 0.3)), GradientNoise(2).at(Vec2(0.4, 0.3)));
}

TEST(Fractal, StaysWithinOneRidgedOrNot) {
  const GradientNoise noise(5);
  for (const double ridged : {0.0, 0.5, 1.0}) {
    double lowest = 1, highest = -1;
    for (int i = 0; i < 20'000; ++i) {
      const double h = fractal(noise, Vec2(0.0713 * i, 0.031 * i), {.ridged = ridged});
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
    }
    EXPECT_GE(lowest, -1);
    EXPECT_LE(highest, 1);
    EXPECT_GT(highest - lowest, 0.7);
  }
}

}  // namespace
}  // namespace talus
