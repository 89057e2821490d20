#include "talus/field/swept_tube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "field/outlines.h"
#include "talus/field/mesh_support.h"
#include "talus/field/profile_curve.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

// Lies to the right of its path, and is not convex.
std::vector<Vec2> hook() {
  const ProfileCurve curve({{1, 0}, {6, -1}, {7, 3}, {5, 4}, {5, 1}, {1, 2}});
  return sample_alike(std::vector{curve}, 0.2).front();
}

// Rings on a circle around (0, 0), to the left of it; `turn` of a whole one.
std::vector<TubeRing> bend(double radius, double turn, int count,
                           const std::vector<Vec2>& outline) {
  std::vector<TubeRing> rings;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * turn * i / count;
    rings.push_back({radius * Vec3(std::cos(angle), std::sin(angle), 0),
                     Vec3(-std::sin(angle), std::cos(angle), 0), Vec3(0, 0, 1), outline});
  }
  return rings;
}

TEST(SweptTube, StraightHasTheVolumeOfItsOutlineTimesItsLength) {
  const std::vector<Vec2> outline = hook();
  const Vec3 along = glm::normalize(Vec3(1, 2, 0.5)), up = glm::normalize(Vec3(-0.5, 0, 1));
  std::vector<TubeRing> rings;
  for (const double s : {0.0, 1.0, 5.0, 20.0}) rings.push_back({s * along, along, up, outline});
  const TriangleMesh tube = swept_tube(rings, false);
  const MeshCheck check = check_mesh(tube);
  EXPECT_TRUE(check.closed() && check.manifold() && check.oriented());
  EXPECT_NEAR(signed_volume(tube), 20 * test::area(outline), 1e-3 * test::area(outline));
}

TEST(SweptTube, LoopsCloseWithoutEnds) {
  const std::vector<Vec2> outline = hook();
  const TriangleMesh ring = swept_tube(bend(10, 1, 400, outline), true);
  const MeshCheck check = check_mesh(ring);
  EXPECT_TRUE(check.closed() && check.manifold() && check.oriented());
  // Pappus: the outline's center of mass goes around.
  double moment = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    moment += (a.x + b.x) * (a.x * b.y - a.y * b.x) / 6;
  }
  const double volume = 2 * std::numbers::pi * (10 * test::area(outline) + moment);
  EXPECT_NEAR(signed_volume(ring) / volume, 1, 1e-3);
}

// A crescent of 1200 points: triangles that reach over its hollow would come apart if deformed.
TEST(SweptTube, EndsOfManyPointsAreCoveredOnce) {
  std::vector<Vec2> outline;
  for (int i = 0; i < 1200; ++i) {
    const bool outer = i < 600;
    const double angle = (outer ? i : 1199 - i) * 1.6 * std::numbers::pi / 599;
    outline.push_back((outer ? 5.0 : 4.0) * Vec2(std::cos(angle), std::sin(angle)));
  }
  const TriangleMesh tube =
      swept_tube(std::vector<TubeRing>{{Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1), outline},
                                       {Vec3(0, 7, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), outline}},
                 false);
  const MeshCheck check = check_mesh(tube);
  EXPECT_TRUE(check.closed() && check.manifold() && check.oriented());
  double covered = 0;
  for (const Triangle& t : tube.triangles) {
    const Vec3 a(tube.positions[t.x]), b(tube.positions[t.y]), c(tube.positions[t.z]);
    if (a.y == b.y && b.y == c.y) covered += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  EXPECT_NEAR(covered, 2 * test::area(outline), 1e-2);
}

// Outlines wider than the bend, toward its center: nothing is turned inside out.
TEST(SweptTube, TightBendsAreNowhereWoundAroundNegatively) {
  std::vector<Vec2> outline;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    outline.emplace_back(4 * std::cos(angle), 2 * std::sin(angle));
  }
  for (const double radius : {0.5, 1.0, 3.0}) {
    const std::vector<TubeRing> rings = bend(radius, 0.6, 60, outline);
    const TriangleMesh tube = swept_tube(rings, false);
    // Each piece between two rings has a volume that is not negative.
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      std::vector<TubeRing> two(rings.begin() + static_cast<std::ptrdiff_t>(i),
                                rings.begin() + static_cast<std::ptrdiff_t>(i) + 2);
      EXPECT_GT(signed_volume(swept_tube(two, false)), 0);
    }
    // On the outside of the bend nothing is drawn in.
    for (std::size_t i = 0; i < rings.size(); ++i)
      EXPECT_NEAR(glm::length(Vec3(tube.positions[40 * i])), radius + 4, 1e-4);
    const MeshSupport inside(tube);
    for (const TubeRing& ring : rings)
      for (const double outward : {0.5, 2.0, 3.9})
        EXPECT_TRUE(inside.contains(ring.at + outward * glm::cross(ring.along, ring.up)) ||
                    &ring == &rings.front() || &ring == &rings.back());
  }
}

// In each of a loop's bends, wherever its rings begin.
TEST(SlabsInBends, AreClosedAndInEveryTightBendOfALoop) {
  const std::vector<Vec2> outline = hook();
  // Three bends, each around a center to the right of it, wider apart than the rings reach.
  std::vector<TubeRing> rings;
  for (int corner = 0; corner < 3; ++corner)
    for (int i = 0; i <= 24; ++i) {
      const double turn = -2 * std::numbers::pi / 3 * (corner + i / 24.0);
      const double middle = -2 * std::numbers::pi / 3 * (corner + 0.5);
      const double radius = 1 + 0.002 * (i - 12) * (i - 12);
      const Vec3 along(std::cos(turn), std::sin(turn), 0);
      const Vec3 outward(-std::sin(turn), std::cos(turn), 0);
      const Vec3 center(-30 * std::sin(middle), 30 * std::cos(middle), 0);
      rings.push_back({center + radius * outward, along, Vec3(0, 0, 1), outline});
    }
  const auto slabs = slabs_in_bends(rings, true, 0.3);
  EXPECT_EQ(slabs.size(), 3u);
  for (const TriangleMesh& slab : slabs) {
    const MeshCheck check = check_mesh(slab);
    EXPECT_TRUE(check.closed() && check.manifold() && check.oriented());
    EXPECT_NEAR(signed_volume(slab), 0.6 * test::area(outline), 1e-4);
  }
  for (std::size_t first = 0; first < rings.size(); ++first) {
    std::rotate(rings.begin(), rings.begin() + 1, rings.end());
    EXPECT_EQ(slabs_in_bends(rings, true, 0.3).size(), 3u) << first;
  }
}

}  // namespace
}  // namespace talus
