#include "talus/render/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "render/heap.h"
#include "render/pictures.h"
#include "talus/render/camera.h"
#include "talus/render/headless_context.h"
#include "talus/render/renderer.h"

namespace talus {
namespace {

using test::brightness;
using test::changes;
using test::pixel;

using HeadlessContextTest = test::Picture;
using Picture = test::Picture;

InstanceTable spheres(std::vector<Instance> instances) {
  return {{std::make_shared<TriangleMesh>(test::sphere(5))}, std::move(instances)};
}

ViewParams small_picture() {
  return {.width = 320, .height = 240, .eye = Vec3(0, -8, 0), .target = Vec3(0, 0, 0)};
}

TEST_F(HeadlessContextTest, OffersOpenGl45) {
  const HeadlessContext context;
  EXPECT_GE(context.version_number(), 45);
  EXPECT_NE(context.version(), "");
}

TEST_F(HeadlessContextTest, OutlivesAnother) {
  const HeadlessContext context;
  { const HeadlessContext other; }
  const InstanceTable table = spheres({{}});
  EXPECT_EQ(render_picture({.stones = &table}, {.width = 64, .height = 64}).pixels.size(),
            64u * 64 * 3);
}

TEST_F(Picture, RepeatsByteForByte) {
  const InstanceTable table =
      test::heap(0.25, 5, 2, [](const Vec3& p) { return glm::length(p) < 1; });
  const RenderScene scene = {.stones = &table, .ground = 0};
  const ViewParams params = {.width = 320, .height = 200};
  const Image first = render_picture(scene, params);
  EXPECT_EQ(first.pixels, render_picture(scene, params).pixels);
  EXPECT_EQ(first.channels, 3);
  EXPECT_EQ(first.width, 320);
  EXPECT_EQ(first.height, 200);
}

TEST_F(Picture, LoneSphereCoversItsProjection) {
  const InstanceTable table = spheres({{}});
  const InstanceTable elsewhere = spheres({{.position = {0, -80, 0}}});
  const ViewParams params = small_picture();
  const auto covered = changes(render_picture({.stones = &table}, params),
                               render_picture({.stones = &elsewhere}, params), 2);

  // A ball of radius 1 at distance 8, seen head-on, is a disk of tangent 1 / sqrt(8^2 - 1).
  const double pixels_per_unit = 120 / std::tan(glm::radians(params.field_of_view_deg / 2));
  const double area = std::numbers::pi * pixels_per_unit * pixels_per_unit / 63;
  EXPECT_NEAR(static_cast<double>(covered.size()), area, 0.02 * area);
  glm::dvec2 middle(0);
  for (const glm::ivec2& p : covered) middle += glm::dvec2(p) + 0.5;
  middle /= static_cast<double>(covered.size());
  EXPECT_NEAR(middle.x, 160, 0.5);
  EXPECT_NEAR(middle.y, 120, 0.5);
}

TEST_F(Picture, FirstRowIsTheTop) {
  const InstanceTable table = spheres({{.position = {0, 0, 1.2}, .scale = 0.4f}});
  const InstanceTable elsewhere = spheres({{.position = {0, -80, 1.2}, .scale = 0.4f}});
  const auto covered = changes(render_picture({.stones = &table}, small_picture()),
                               render_picture({.stones = &elsewhere}, small_picture()), 2);
  ASSERT_FALSE(covered.empty());
  for (const glm::ivec2& p : covered) EXPECT_LT(p.y, 120);
}

TEST_F(Picture, HiddenStoneLeavesNoTrace) {
  // The outer two fix the scene's size; the last hides behind the first, also from the sun.
  const std::vector<Instance> stones = {
      {}, {.position = {2.4, 2.4, 0}}, {.position = {0, 2.4, 0}, .scale = 0.5f}};
  const InstanceTable all = spheres(stones);
  const InstanceTable without = spheres({stones[0], stones[1]});
  ViewParams params = small_picture();
  params.sun_azimuth_deg = 180;
  params.sun_elevation_deg = 2;
  EXPECT_TRUE(changes(render_picture({.stones = &all}, params),
                      render_picture({.stones = &without}, params))
                  .empty());
}

TEST_F(Picture, ShadowFallsAwayFromTheSun) {
  const InstanceTable table = spheres({{.position = {0, 0, 1}}});
  const RenderScene scene = {.stones = &table, .ground = 0};
  ViewParams params = small_picture();
  params.eye = Vec3(0, 0, 20);
  params.sun_elevation_deg = 30;
  const auto at = [&](const Vec3& p, const Image& image) {
    const double pixels_per_unit = 120 / std::tan(glm::radians(params.field_of_view_deg / 2)) / 20;
    return brightness(image, 160 + static_cast<int>(p.x * pixels_per_unit),
                      120 - static_cast<int>(p.y * pixels_per_unit));
  };
  for (const double azimuth : {0.0, 90.0, 225.0}) {
    params.sun_azimuth_deg = azimuth;
    const Image image = render_picture(scene, params);
    const Vec3 toward_sun = compass_direction(azimuth, 0);
    // The shadow of a ball lit from 30 degrees is centered 1 / tan(30 deg) = 1.73 away.
    EXPECT_LT(at(-1.9 * toward_sun, image), 0.7 * at(1.9 * toward_sun, image)) << azimuth;
  }
}

TEST_F(Picture, EmptySceneShowsSkyAboveGround) {
  const ViewParams params = {.width = 160, .height = 120, .elevation_deg = 5};
  const Image sky = render_picture({}, params);
  const Image ground = render_picture({.ground = 0}, params);
  const auto changed = changes(sky, ground);
  EXPECT_GT(changed.size(), 160u * 120 / 4);
  for (const glm::ivec2& p : changed) EXPECT_GT(p.y, 10);
  EXPECT_GT(pixel(sky, 80, 5).z, pixel(sky, 80, 5).x);
}

TEST_F(Picture, LooksTheSameFarFromTheOrigin) {
  InstanceTable table = test::heap(0.25, 5, 2, [](const Vec3& p) { return glm::length(p) < 1; });
  const ViewParams params = {.width = 320, .height = 200};
  const Image near = render_picture({.stones = &table, .ground = 0}, params);
  for (Instance& instance : table.instances) instance.position += Vec3(1e6, -1e6, 3000);
  const Image far = render_picture({.stones = &table, .ground = 3000}, params);
  EXPECT_LT(changes(near, far, 8).size(), near.pixels.size() / 3 / 500);
}

TEST_F(Picture, ShowsScenesOfEverySize) {
  const ViewParams params = {.width = 160, .height = 120};
  const auto picture = [&](double unit) {
    const InstanceTable table =
        spheres({{.position = {0, 0, unit}, .scale = static_cast<float>(unit)}});
    return render_picture({.stones = &table, .ground = 0}, params);
  };
  const Image metre = picture(1);
  EXPECT_GT(changes(metre, render_picture({.ground = 0}, params), 20).size(), 2000u);
  EXPECT_LT(changes(metre, picture(0.0005), 8).size(), 100u);
  EXPECT_LT(changes(metre, picture(1000), 8).size(), 100u);
}

TEST_F(Picture, DrawsPlainMeshesInTheirColor) {
  TriangleMesh sheet;  // without normals, facing away from the camera
  sheet.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  sheet.triangles = {{0, 2, 1}, {0, 3, 2}};
  ViewParams params = small_picture();
  params.sun_azimuth_deg = 180;
  const Image red =
      render_picture({.meshes = {{.mesh = &sheet, .color = {0.6f, 0.02f, 0.02f}}}}, params);
  const glm::ivec3 middle = pixel(red, 160, 120);
  EXPECT_GT(middle.x, 2 * middle.y);
  EXPECT_GT(middle.x, 2 * middle.z);
}

TEST_F(Picture, RefusesPositionsThatAreNoNumbers) {
  const InstanceTable table = spheres({{.position = {std::nan(""), 0, 0}}});
  EXPECT_THROW(render_picture({.stones = &table}), Error);
}

TEST_F(Picture, OpenGlErrorsAreFatal) {
  const HeadlessContext context;
  Renderer renderer;
  renderer.set_scene({.ground = 0});
  constexpr std::uint32_t kNoSuchFramebuffer = 12345;
  try {
    renderer.draw({.width = 64, .height = 64}, kNoSuchFramebuffer);
    ADD_FAILURE() << "drew into a framebuffer that does not exist";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::job);
  }
}

TEST_F(Picture, CanBeCancelledMidway) {
  struct Impatient : Job {
    void progress(std::string_view, double fraction) override {
      if (fraction > 0.5) cancel();
    }
  } job;
  const InstanceTable table = spheres({{}});
  EXPECT_THROW(render_picture({.stones = &table}, {.width = 64, .height = 64}, &job), Cancelled);
}

}  // namespace
}  // namespace talus
