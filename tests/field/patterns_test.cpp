#include "talus/field/patterns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "talus/base/error.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

// Height of the bed at a place.
double height(const Raked& raked, double x, double y) {
  const DistanceFunction distance = distance_function(raked);
  double low = 0, high = raked.thickness + raked.ridge + 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (distance({x, y, middle}) <= 0 ? low : high) = middle;
  }
  return low;
}

TEST(Patterns, RowsRunAlongTheirDirection) {
  const Raked raked{.ridge = 0.1, .spacing = 0.4};
  for (double x = -2.5; x < 2.5; x += 0.37) {
    EXPECT_NEAR(height(raked, x, 0.4), 0.1, 1e-9) << "a furrow";
    EXPECT_NEAR(height(raked, x, 0.2), 0.2, 1e-9) << "a ridge";
  }
  const Raked turned{.ridge = 0.1, .spacing = 0.4, .direction_deg = 90};
  for (double y = -1.5; y < 1.5; y += 0.37) EXPECT_NEAR(height(turned, 0.2, y), 0.2, 1e-9);
}

TEST(Patterns, RingsSurroundTheirCenterAndEndInAFurrow) {
  const Raked raked{.size = {8, 8}, .ridge = 0.1, .spacing = 0.4, .rings = {{1, 0.5, 1.9}}};
  for (double angle = 0; angle < 6; angle += 0.3) {
    const auto at = [&](double r) {
      return height(raked, 1 + r * std::cos(angle), 0.5 + r * std::sin(angle));
    };
    EXPECT_NEAR(at(0.8), 0.1, 1e-9);
    EXPECT_NEAR(at(1.0), 0.2, 1e-9);
    EXPECT_NEAR(at(1.9), 0.1, 1e-9);
  }
}

TEST(Patterns, RingsThatMeetRunOutIntoAFurrow) {
  const Raked raked{.size = {8, 8}, .rings = {{-1, 0, 1.5}, {1, 0, 1.5}}};
  for (double y = -1; y < 1; y += 0.13) EXPECT_NEAR(height(raked, 0, y), 0.1, 1e-9);
}

TEST(Patterns, CoursesLeaveTheirJointsEmpty) {
  const ShapeSupport wall(Combination{
      Combination::Rule::intersect, 0, {Box{{0, 0, 1}, {4, 1, 2}, 0}, Courses{0, 0.5, 0.1}}});
  for (const double z : {0.01, 0.39, 0.51, 0.89, 1.2}) EXPECT_TRUE(wall.contains({1, 0, z})) << z;
  for (const double z : {0.41, 0.49, 0.91, 1.95, 2.1}) EXPECT_FALSE(wall.contains({1, 0, z})) << z;
}

TEST(Patterns, ASpiralWindsOutwardByItsPitch) {
  const ShapeSupport spiral(Spiral{{0, 0, 0}, 1, 4, 1, 0.4, 0.5});
  for (double turns = 0.01; turns < 2.7; turns += 0.09) {
    const double angle = 2 * M_PI * turns;
    const auto at = [&](double r) {
      return spiral.contains({r * std::cos(angle), r * std::sin(angle), 0.2});
    };
    EXPECT_TRUE(at(1 + turns)) << turns;
    EXPECT_FALSE(at(1.5 + turns)) << turns;
  }
  EXPECT_FALSE(spiral.contains({1.1, 0, 0.6}));
}

TEST(Patterns, RefuseFieldsThatDoNotFit) {
  EXPECT_THROW(ShapeSupport(Raked{.rings = {{0, 0, -1}}}), Error);
  EXPECT_THROW(ShapeSupport(Courses{0, 0.5, 0.5}), Error);
  EXPECT_THROW(ShapeSupport(Spiral{{0, 0, 0}, 2, 1, 1, 0.5, 0.5}), Error);
  EXPECT_THROW(ShapeSupport(Spiral{{0, 0, 0}, 1, 3, 1, 1, 0.5}), Error);
}

}  // namespace
}  // namespace talus
