#include "talus/base/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "talus/base/hash.h"

namespace talus {
namespace {

double drawn(int i, int which, double most) {
  return uniform(hash(5, Purpose::texture, i, which), -most, most);
}

TEST(Elementary, AgreesWithTheLibrary) {
  for (int i = 0; i < 100'000; ++i) {
    const double x = drawn(i, 0, i % 2 ? 10 : 1e6), y = drawn(i, 1, 5);
    const double sized = 4e-16 + 2e-16 * std::abs(x);
    ASSERT_NEAR(sine(x), std::sin(x), sized) << x;
    ASSERT_NEAR(cosine(x), std::cos(x), sized) << x;
    ASSERT_NEAR(angle_of(y, x), std::atan2(y, x), 1e-15) << y << " " << x;
    const double e = std::exp(100 * y);
    ASSERT_NEAR(exponential(100 * y), e, 1e-15 * e) << y;
    ASSERT_NEAR(logarithm(e), std::log(e), 1e-15 * std::max(1.0, std::abs(100 * y))) << e;
  }
}

TEST(Elementary, KnowsTheEnds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sine(0), 0);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(angle_of(0, 0), 0);
  EXPECT_EQ(exponential(1e4), kInfinity);
  EXPECT_EQ(exponential(-1e4), 0);
  EXPECT_EQ(logarithm(0), -kInfinity);
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  for (const double value : {sine(kInfinity), sine(kNan), cosine(1e12), exponential(kNan),
                             logarithm(-1), logarithm(kNan), angle_of(kNan, 1)})
    EXPECT_TRUE(std::isnan(value)) << value;
}

}  // namespace
}  // namespace talus
