#include "talus/tools/sweep_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "talus/base/error.h"
#include "talus/base/hash.h"

namespace talus {
namespace {

using Nodes = std::vector<std::size_t>;

std::vector<PathPoint> random_points(std::uint64_t seed) {
  std::vector<PathPoint> points;
  const int n = 3 + static_cast<int>(hash(seed, Purpose::texture, -1) % 5);
  for (int i = 0; i < n; ++i) {
    const auto draw = [&](int k) { return uniform(hash(seed, Purpose::texture, i, k), -40, 40); };
    points.push_back({Vec3(draw(0), draw(1), 0.3 * draw(2)), Vec3(0, 0, 1), double(i)});
  }
  return points;
}

TEST(Strands, TheFirstTwoArcsOfANodeGoThroughIt) {
  const std::vector<SweepArc> fork{{0, 1}, {1, 2}, {1, 3}, {3, 4}};
  const auto strands = find_strands(5, fork);
  ASSERT_EQ(strands.size(), 2u);
  EXPECT_EQ(strands[0].nodes, (Nodes{0, 1, 2}));
  EXPECT_EQ(strands[1].nodes, (Nodes{1, 3, 4}));
}

TEST(Strands, GoOnWhicheverWayTheirArcsAreGiven) {
  const std::vector<SweepArc> arcs{{2, 1}, {2, 3}, {0, 1}, {4, 3}};
  const auto strands = find_strands(5, arcs);
  ASSERT_EQ(strands.size(), 1u);
  EXPECT_EQ(strands[0].nodes, (Nodes{4, 3, 2, 1, 0}));
  EXPECT_FALSE(strands[0].loop);
}

TEST(Strands, LoopsAreFound) {
  const std::vector<SweepArc> arcs{{0, 1}, {1, 2}, {2, 0}, {2, 3}};
  const auto strands = find_strands(4, arcs);
  ASSERT_EQ(strands.size(), 2u);
  EXPECT_TRUE(strands[0].loop);
  EXPECT_EQ(strands[0].nodes, (Nodes{1, 2, 0}));
  EXPECT_EQ(strands[1].nodes, (Nodes{2, 3}));
}

// Random graphs: each arc is in one strand, between neighbors of it.
TEST(Strands, HoldEveryArcOnce) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    constexpr int kNodes = 7;
    std::vector<SweepArc> arcs;
    std::vector<std::pair<int, int>> wanted, found;
    for (int a = 0; a < kNodes; ++a)
      for (int b = a + 1; b < kNodes; ++b)
        if (hash(seed, Purpose::texture, a, b) % 3 == 0) {
          arcs.push_back((a + b) % 2 ? SweepArc{a, b} : SweepArc{b, a});
          wanted.emplace_back(a, b);
        }
    for (const Strand& strand : find_strands(kNodes, arcs)) {
      const std::size_t n = strand.nodes.size();
      for (std::size_t i = 0; i + 1 < n + strand.loop; ++i) {
        const int a = static_cast<int>(strand.nodes[i]);
        const int b = static_cast<int>(strand.nodes[(i + 1) % n]);
        found.emplace_back(std::minmax(a, b));
      }
    }
    std::ranges::sort(found);
    std::ranges::sort(wanted);
    EXPECT_EQ(found, wanted) << seed;
  }
}

TEST(SmoothPath, GoesThroughItsPointsInSmallStepsThatTurnLittle) {
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    for (const bool loop : {false, true})
      for (const double spacing : {0.5, HUGE_VAL}) {
        const std::vector<PathPoint> points = random_points(seed);
        std::vector<PathPoint> path = smooth_path(points, loop, spacing);
        for (const PathPoint& p : points)
          EXPECT_TRUE(std::ranges::any_of(path, [&](const PathPoint& q) {
            return glm::length(q.at - p.at) < 1e-9 && std::abs(q.place - p.place) < 1e-9;
          }));
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
          ASSERT_LT(path[i].place, path[i + 1].place);
          ASSERT_LT(glm::length(path[i + 1].at - path[i].at), 1.5 * spacing);
        }
        EXPECT_LT(path.back().place, static_cast<double>(points.size()) - !loop + 1e-9);
        const std::vector<Vec3> along = orient_path(path, loop, 1);
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
          EXPECT_GT(glm::dot(along[i], along[i + 1]), std::cos(0.15)) << seed;
      }
}

TEST(SmoothPath, OfTwoPointsIsStraight) {
  const std::vector<PathPoint> ends{{.at = {0, 0, 0}, .place = 0}, {.at = {10, 5, 2}, .place = 1}};
  for (const PathPoint& p : smooth_path(ends, false, 0.3))
    EXPECT_LT(glm::length(p.at - p.place * ends[1].at), 1e-9);
  EXPECT_THROW(smooth_path(ends, false, 1e-6), Error);
}

// Its last span turns, and so takes more points than its length asks for.
TEST(SmoothPath, IsOfAMillionPointsAtMost) {
  const std::vector<PathPoint> hook{
      {.at = {0, 0, 0}}, {.at = {1000, 0, 0}, .place = 1}, {.at = {999, 0.01, 0}, .place = 2}};
  EXPECT_EQ(smooth_path(hook, false, 0.0010010131).size(), 1'000'000u);
  EXPECT_THROW(smooth_path(hook, false, 0.001001010), Error);
}

TEST(OrientPath, StandsUprightAndKeepsItsWayInAShaft) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::vector<PathPoint> path = smooth_path(random_points(seed), false, 0.5);
    const std::vector<Vec3> along = orient_path(path, false, 1);
    for (std::size_t i = 0; i < path.size(); ++i) {
      ASSERT_NEAR(glm::length(path[i].up), 1, 1e-12);
      ASSERT_NEAR(glm::dot(path[i].up, along[i]), 0, 1e-12);
      ASSERT_TRUE(std::isfinite(path[i].up.x));
    }
  }
  // Level, then down, then level again the other way.
  std::vector<PathPoint> shaft;
  for (int i = 0; i <= 90; ++i) {
    const double angle = i * std::numbers::pi / 90;
    shaft.push_back({.at = {10 * std::sin(angle), 0, 10 * std::cos(angle)}});
  }
  orient_path(shaft, false, 2);
  EXPECT_GT(shaft.front().up.z, 0.99);
  EXPECT_GT(shaft[45].up.x, 0.9) << "as it came";
  EXPECT_GT(shaft.back().up.z, 0.99);
  for (std::size_t i = 0; i + 1 < shaft.size(); ++i)
    EXPECT_GT(glm::dot(shaft[i].up, shaft[i + 1].up), 0.97) << "by less than a quarter radian";
}

// Also where its points' `up`s are opposed, and where it turns back a hair above itself.
TEST(OrientPath, AlwaysFindsDirections) {
  std::vector<std::vector<PathPoint>> paths{
      {{.at = {0, 0, 0}}, {.at = {10, 0, 0}}, {.at = {0, 0, 1e-17}}}};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::vector<PathPoint> points = random_points(seed);
    for (std::size_t i = 1; i < points.size(); i += 2) points[i].up = Vec3(0, 0, -1);
    paths.push_back(smooth_path(points, false, 0.5));
  }
  for (std::vector<PathPoint> path : paths)
    for (const bool loop : {false, true}) {
      const std::vector<Vec3> along = orient_path(path, loop, 1);
      for (std::size_t i = 0; i < path.size(); ++i) {
        ASSERT_NEAR(glm::length(along[i]), 1, 1e-12);
        ASSERT_NEAR(glm::length(path[i].up), 1, 1e-12);
        ASSERT_NEAR(glm::dot(path[i].up, along[i]), 0, 1e-9);
      }
    }
}

}  // namespace
}  // namespace talus
