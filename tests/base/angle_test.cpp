#include "talus/base/angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace talus {
namespace {

TEST(Angle, EqualsTheCLibrarys) {
  for (int i = -4000; i <= 4000; ++i) {
    const double degrees = 0.1837 * i;
    const double radians = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(sin_deg(degrees), std::sin(radians), 1e-14) << degrees;
    EXPECT_NEAR(cos_deg(degrees), std::cos(radians), 1e-14) << degrees;
  }
}

TEST(Angle, QuarterTurnsAreExact) {
  for (int quarter = -8; quarter <= 8; ++quarter) {
    constexpr double kSines[4] = {0, 1, 0, -1};
    EXPECT_EQ(sin_deg(90.0 * quarter), kSines[quarter & 3]);
    EXPECT_EQ(cos_deg(90.0 * quarter), kSines[(quarter + 1) & 3]);
  }
}

}  // namespace
}  // namespace talus
