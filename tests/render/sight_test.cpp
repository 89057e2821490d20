#include "talus/render/sight.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render/heap.h"
#include "talus/base/hash.h"
#include "talus/render/coarse_mesh.h"
#include "talus/render/projection.h"
#include "talus/render/standpoint.h"

namespace talus {
namespace {

double random(int what, int i, double low, double high) {
  return uniform(hash(7, Purpose::texture, what, i), low, high);
}

Ball random_ball(int i) {
  return {.center = {random(1, i, -1, 1), random(2, i, -1, 1), random(3, i, -1, 1)},
          .radius = random(4, i, 0, 0.3)};
}

// Whether a place is in a picture whose clip space this is.
bool shown(const glm::dmat4& clip_from_view, const Vec3& p) {
  const glm::dvec4 c = clip_from_view * glm::dvec4(p, 1);
  return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z <= c.w && c.z >= 0;
}

TEST(Sight, NeverMissesABallThatShows) {
  int missed = 0;
  for (int view = 0; view < 40; ++view) {
    const Vec3 eye(random(5, view, -1.5, 1.5), random(6, view, -1.5, 1.5), random(7, view, -1, 1));
    const Camera camera = make_camera(
        {}, {.field_of_view_deg = random(8, view, 5, 100),
             .eye = eye,
             .target = eye + Vec3(random(9, view, -1, 1), random(10, view, -1, 1), 0.3)});
    const glm::dmat4 clip = clip_from_view(camera, 1e-6);
    const Sight sight(clip, 1000);
    for (int i = 0; i < 200; ++i) {
      const Ball ball = random_ball(200 * view + i);
      bool reaches = false;
      for (int k = 0; k < 60 && !reaches; ++k)
        reaches =
            shown(clip, ball.center + ball.radius * compass_direction(41.0 * k, 3.0 * k - 90));
      EXPECT_TRUE(sight.sees(ball) || !reaches);
      missed += !sight.sees(ball);
    }
  }
  EXPECT_GT(missed, 3000) << "most balls are out of sight";
}

TEST(Sight, MeasuresBallsInSamples) {
  const Camera camera =
      make_camera({}, {.field_of_view_deg = 90, .eye = Vec3(0), .target = Vec3(0, 1, 0)});
  const Sight sight(clip_from_view(camera, 1e-6), 500);
  const double across = sight.samples_across({.center = {0, 10, 0}, .radius = 0.1});
  EXPECT_GE(across, 2 * 0.1 * 500 / 10);
  EXPECT_LT(across, 1.02 * 2 * 0.1 * 500 / 10);
}

TEST(SunMaps, LastHoldsAllAndFinerOnesAreFiner) {
  std::vector<Ball> balls;
  for (int i = 0; i < 50; ++i) balls.push_back(random_ball(i));
  const Camera camera = make_camera({}, {.eye = Vec3(-0.9, 0, 0), .target = Vec3(0, 0, 0)});
  const auto maps = fit_sun(balls, compass_direction(130, 36), camera, 1024, 4);
  ASSERT_GE(maps.size(), 3u);
  ASSERT_LE(maps.size(), 4u);
  for (std::size_t i = 1; i < maps.size(); ++i) EXPECT_LT(maps[i - 1].texel, maps[i].texel);
  for (const Ball& ball : balls)
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = ball.center + ball.radius * compass_direction(53.0 * k, 9.0 * k - 90);
      const Vec3 at(maps.back().map_from_view * glm::dvec4(p, 1));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(at[axis], 0);
        EXPECT_LT(at[axis], 1);
      }
    }
}

TEST(SunMaps, DistantSceneNeedsOne) {
  const std::vector<Ball> balls = {{.center = {0, 0, 0}, .radius = 1}};
  const Camera camera = make_camera(balls, {});
  EXPECT_EQ(fit_sun(balls, compass_direction(130, 36), camera, 1024, 4).size(), 1u);
}

TEST(SkyDirections, AreUnitAndSpreadEvenlyAboveTheHorizon) {
  const auto directions = sky_directions();
  Vec3 sum(0);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(glm::length(directions[i]), 1, 1e-12);
    EXPECT_GT(directions[i].z, 0);
    sum += directions[i];
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(glm::distance(directions[i], directions[j]), 0.25);
  }
  // The mean of a hemisphere lies half-way up.
  EXPECT_LT(glm::distance(sum / static_cast<double>(directions.size()), Vec3(0, 0, 0.5)), 0.03);
}

TEST(CoarseMesh, StaysWithinACellsDiagonalOfTheMesh) {
  const TriangleMesh fine = test::stone(3, 4);
  for (const int cells : {3, 6, 12}) {
    const TriangleMesh coarse = coarse_mesh(fine, cells);
    EXPECT_LT(coarse.triangles.size(), fine.triangles.size());
    EXPECT_GE(coarse.triangles.size(), 12u);
    const double cell = bounds(fine).longest_side() / cells;
    for (const Vec3f& p : coarse.positions) {
      double nearest = 9;
      for (const Vec3f& q : fine.positions)
        nearest = std::min(nearest, static_cast<double>(glm::distance(p, q)));
      EXPECT_LE(nearest, std::sqrt(3.0) * cell);
    }
    for (const Vec3f& n : coarse.normals) EXPECT_NEAR(glm::length(n), 1, 1e-4);
  }
}

TEST(CoarseMesh, OfNothingIsEmpty) { EXPECT_TRUE(coarse_mesh({}, 8).positions.empty()); }

// A square of 100 m with a roof over its middle.
TriangleMesh roofed() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 5},    {100, 0, 5},  {100, 100, 5}, {0, 100, 5},
                    {40, 40, 20}, {60, 40, 20}, {60, 60, 20},  {40, 60, 20}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

TEST(Standpoint, StandsOnTheHighestSurfaceBelowTheEye) {
  const TriangleMesh mesh = roofed();
  const RenderScene scene = {.meshes = {{.mesh = &mesh, .origin = {1000, 0, 0}}}};
  const auto eye_at = [&](const Vec3& eye) {
    return find_standpoint(scene,
                           {.camera = CameraPreset::low, .eye = eye, .target = Vec3(1000, 0, 5)})
        .eye;
  };
  EXPECT_NEAR(eye_at({1050, 51, 12}).z, 5 + 1.7, 1e-6) << "under the roof";
  EXPECT_NEAR(eye_at({1050, 51, 30}).z, 20 + 1.7, 1e-6) << "on the roof";
  EXPECT_NEAR(eye_at({1010, 11, -30}).z, 5 + 1.7, 1e-6) << "nothing lies below";
}

TEST(Standpoint, ChoosesAPlaceOnTheSideOfTheAzimuth) {
  const TriangleMesh mesh = roofed();
  const RenderScene scene = {.meshes = {{.mesh = &mesh}}};
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
    const Standpoint s =
        find_standpoint(scene, {.camera = CameraPreset::low, .azimuth_deg = azimuth});
    EXPECT_GT(glm::dot(s.eye - Vec3(50, 50, 0), compass_direction(azimuth, 0)), 5) << azimuth;
    EXPECT_NEAR(s.eye.z, 6.7, 1e-6);
  }
}

}  // namespace
}  // namespace talus
