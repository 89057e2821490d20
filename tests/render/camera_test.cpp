#include "talus/render/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace talus {
namespace {

// Where a point appears, in [-1, 1]^2 inside the picture.
glm::dvec2 seen_at(const Camera& camera, const Vec3& p) {
  const Vec3 d = p - camera.eye;
  const double away = glm::dot(d, camera.forward);
  return {glm::dot(d, camera.right) / glm::dot(camera.right, camera.right) / away,
          glm::dot(d, camera.up) / glm::dot(camera.up, camera.up) / away};
}

TEST(Camera, CompassRunsClockwiseFromNorth) {
  EXPECT_LT(glm::distance(compass_direction(0, 0), Vec3(0, 1, 0)), 1e-12);
  EXPECT_LT(glm::distance(compass_direction(90, 0), Vec3(1, 0, 0)), 1e-12);
  EXPECT_LT(glm::distance(compass_direction(123, 90), Vec3(0, 0, 1)), 1e-12);
}

TEST(Camera, StandsWhereAsked) {
  const std::vector<Ball> balls = {{.center = {5, 7, 1}, .radius = 2}};
  const Camera camera =
      make_camera(balls, {.azimuth_deg = 90, .elevation_deg = 30, .field_of_view_deg = 40});
  const Vec3 d = glm::normalize(camera.eye - balls[0].center);
  EXPECT_LT(glm::distance(d, compass_direction(90, 30)), 1e-9);
}

TEST(Camera, FramesEveryBallTightly) {
  const std::vector<Ball> balls = {{.center = {0, 0, 0}, .radius = 0.5},
                                   {.center = {9, 1, 2}, .radius = 1},
                                   {.center = {3, -7, 5}, .radius = 0.1}};
  for (const double azimuth : {0.0, 77.0, 200.0}) {
    const Camera camera = make_camera(balls, {.azimuth_deg = azimuth, .elevation_deg = 25});
    double widest = 0;
    for (const Ball& ball : balls)
      for (int i = 0; i < 400; ++i) {
        const Vec3 on_ball =
            ball.center + ball.radius * compass_direction(17.0 * i, 90 - 180 * i / 399.0);
        const glm::dvec2 at = seen_at(camera, on_ball);
        widest = std::max({widest, std::abs(at.x), std::abs(at.y)});
      }
    EXPECT_LT(widest, 0.9);
    EXPECT_GT(widest, 0.8);
  }
}

TEST(Camera, LooksStraightDownWithNorthUp) {
  const std::vector<Ball> balls = {{.center = {0, 0, 0}, .radius = 1}};
  const Camera camera = make_camera(balls, {.eye = Vec3(0, 0, 10), .target = Vec3(0, 0, 0)});
  EXPECT_GT(seen_at(camera, {0, 1, 0}).y, 0.1);
  EXPECT_GT(seen_at(camera, {1, 0, 0}).x, 0.1);
}

TEST(Camera, ZoomComesCloser) {
  const std::vector<Ball> balls = {{.center = {0, 0, 0}, .radius = 1}};
  const double far = glm::length(make_camera(balls, {}).eye);
  const double near = glm::length(make_camera(balls, {.zoom = 2}).eye);
  EXPECT_NEAR(near, far / 2, 1e-9);
}

void expect_refused(const ViewParams& params, const std::string& word) {
  try {
    validate_view(params);
    ADD_FAILURE() << "accepted although " << word << " is wrong";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(ViewParams, WrongValuesAreRefusedByName) {
  EXPECT_NO_THROW(validate_view({}));
  expect_refused({.width = 0}, "width");
  expect_refused({.height = 1'000'000}, "height");
  expect_refused({.field_of_view_deg = 180}, "field_of_view_deg");
  expect_refused({.zoom = 0}, "zoom");
  expect_refused({.sun_elevation_deg = -5}, "sun_elevation_deg");
  expect_refused({.sun_azimuth_deg = std::nan("")}, "sun_azimuth_deg");
  expect_refused({.eye = Vec3(1, 2, 3)}, "target");
  expect_refused({.camera = CameraPreset::inside}, "inside");
  expect_refused({.eye = Vec3(1, 2, 3), .target = Vec3(1, 2, 3)}, "eye");
}

}  // namespace
}  // namespace talus
