#include "talus/field/profile_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "field/outlines.h"
#include "talus/base/error.h"
#include "talus/base/hash.h"

namespace talus {
namespace {

double uniform_at(std::uint64_t seed, int k, double low, double high) {
  return uniform(hash(seed, Purpose::texture, k), low, high);
}

// A star around the origin, convex only by chance.
std::vector<Vec2> random_star(std::uint64_t seed) {
  const int n = 3 + static_cast<int>(hash(seed, Purpose::texture, -1) % 9);
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, radius = uniform_at(seed, i, 2, 4);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

TEST(ProfileCurve, GoesThroughItsPointsCounterclockwiseHoweverTheyAreGiven) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::vector<Vec2> points = random_star(seed);
    const auto n = static_cast<double>(points.size());
    const ProfileCurve curve(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT(glm::length(curve.at(static_cast<double>(i) / n) - points[i]), 1e-12);
    std::reverse(points.begin() + 1, points.end());
    const ProfileCurve reversed(points);
    for (double t = 0; t < 1; t += 0.01) EXPECT_LT(glm::length(curve.at(t) - reversed.at(t)), 1e-9);
    EXPECT_GT(test::area(sample_alike(std::vector{curve}, 0.1).front()), 0);
  }
}

TEST(ProfileCurve, IsSmooth) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ProfileCurve curve(random_star(seed));
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int k) { return curve.at(double((i + k) % n) / n); };
      const Vec2 a = glm::normalize(at(1) - at(0)), b = glm::normalize(at(2) - at(1));
      ASSERT_GT(glm::dot(a, b), 0.99);
    }
  }
}

TEST(ProfileCurve, EightPointsOfACircleAreNearlyOne) {
  std::vector<Vec2> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(std::cos(i * std::numbers::pi / 4), std::sin(i * std::numbers::pi / 4));
  const ProfileCurve curve(points);
  for (double t = 0; t < 1; t += 0.01) EXPECT_NEAR(glm::length(curve.at(t)), 1, 0.01);
  EXPECT_NEAR(curve.reach(), 1, 0.01);
}

TEST(ProfileCurve, SamplesCurvesAlikeAndCloselyEnough) {
  const std::vector<ProfileCurve> curves{ProfileCurve(random_star(1)), ProfileCurve(random_star(2)),
                                         ProfileCurve({{9, 0}, {0, 1}, {-9, 0}, {0, -1}})};
  for (const double spacing : {0.02, 0.1, 1.0, HUGE_VAL}) {
    const auto outlines = sample_alike(curves, spacing);
    ASSERT_EQ(outlines.size(), curves.size());
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const std::vector<Vec2>& outline = outlines[c];
      EXPECT_EQ(outline.size(), outlines[0].size());
      EXPECT_GE(outline.size(), 12 * curves[c].spans());
      EXPECT_EQ(outline.front(), curves[c].at(0));
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const double step = glm::length(outline[(i + 1) % outline.size()] - outline[i]);
        EXPECT_LT(step, 1.1 * spacing);
        EXPECT_GT(step, 0);
      }
    }
  }
}

TEST(ProfileCurve, RefusesWhatIsNoOutline) {
  const auto line = [](std::vector<Vec2> points) {
    try {
      ProfileCurve curve(std::move(points));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(line({{0, 0}, {1, 0}}), "a profile of 2 points encloses nothing; give at least 3");
  EXPECT_EQ(line({{0, 0}, {1e-200, 0}, {2, 0}, {0, 2}}),
            "a profile has the point (0, 0) twice in a row; leave one out");
  std::vector<Vec2> fine;
  for (int i = 0; i < 4000; ++i) fine.emplace_back(std::cos(i * 0.001), std::sin(i * 0.001));
  EXPECT_EQ(line(fine), "a profile of 4000 points is too fine; give at most 256");
  EXPECT_EQ(line({{0, 0}, {1, 0}, {1, 0}}),
            "a profile has the point (1, 0) twice in a row; leave one out");
  EXPECT_EQ(line({{0, 0}, {4, 0}, {0, 4}, {4, 4}}),
            "a profile crosses itself near (2.396, 1.683), between its points 1 and 3; give its "
            "points in order around it");
  EXPECT_EQ(line({{0, 0}, {1, 0}, {std::nan(""), 1}}),
            "a profile's point (nan, 1) is too far away; it may be 1000000 m");
  EXPECT_EQ(line({{0, 0}, {1, 1}, {3, 3}}),
            "a profile's points lie on one line and enclose nothing; move one of them");
  const std::vector curves{ProfileCurve({{1, 0}, {0, 1}, {-1, 0}})};
  EXPECT_THROW(sample_alike(curves, 1e-9), Error);
}

}  // namespace
}  // namespace talus
