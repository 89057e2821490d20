#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <numeric>

#include "render/heap.h"
#include "render/landscape.h"
#include "render/pictures.h"
#include "talus/render/camera.h"
#include "talus/render/picture.h"

namespace talus {
namespace {

using test::brightness;
using test::changes;
using test::mean;

// Skips where there is no OpenGL to draw with.
class LandscapePicture : public test::Picture {};

// A flat square of 8 m, `strips` surfaces side by side from west to east, seen from above.
TriangleMesh strips(int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    MaterialShares shares{};
    shares[static_cast<std::size_t>(i)] = 255;
    for (const glm::ivec2 corner : {glm::ivec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      const float x = static_cast<float>(i + corner.x) / static_cast<float>(count);
      mesh.positions.emplace_back(8 * x - 4, 8.0f * static_cast<float>(corner.y) - 4, 0);
      mesh.shares.push_back(shares);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  return mesh;
}

ViewParams from_above() {
  return {.width = 384, .height = 384, .eye = Vec3(0, 0, 15), .target = Vec3(0, 0, 0)};
}

// Where strip i of `count` lies in a picture taken from above.
glm::ivec2 strip_middle(int i, int count) {
  return {192 + static_cast<int>(383 * (i + 0.5 - 0.5 * count) / count), 192};
}

std::shared_ptr<const SurfaceImages> plain_images(glm::u8vec4 color) {
  auto images = std::make_shared<SurfaceImages>();
  images->albedo = {
      .width = 1, .height = 1, .channels = 4, .pixels = {color.x, color.y, color.z, color.w}};
  return images;
}

TEST_F(LandscapePicture, PatternsShowTheirColor) {
  using P = SurfaceLook::Pattern;
  const std::vector<P> patterns = {P::rock, P::sand, P::soil, P::gravel, P::ice, P::snow};
  const int count = static_cast<int>(patterns.size());
  const TriangleMesh mesh = strips(count);
  RenderScene scene = {.meshes = {{.mesh = &mesh}}};
  for (const P pattern : patterns) scene.surfaces.push_back({.pattern = pattern});
  const Image shown = render_picture(scene, from_above());
  // The same without texture.
  for (SurfaceLook& look : scene.surfaces) look = {.color = mean_color(look)};
  const Image plain = render_picture(scene, from_above());
  for (int i = 0; i < count; ++i) {
    const Vec3 a = mean(shown, strip_middle(i, count), 20);
    const Vec3 b = mean(plain, strip_middle(i, count), 20);
    // From place to place a material is lighter or darker, but of the same hue.
    EXPECT_GT(glm::length(a), 0.7 * glm::length(b)) << i;
    EXPECT_LT(glm::length(a), 1.3 * glm::length(b)) << i;
    EXPECT_LT(glm::distance(glm::normalize(a), glm::normalize(b)), 0.1) << i;
  }
  // What no texture may hide.
  const auto at = [&](int i) { return mean(shown, strip_middle(i, count), 20); };
  EXPECT_GT(at(1).x, 1.2 * at(1).z) << "sand is yellow";
  EXPECT_LT(at(2).x + at(2).y, 0.9 * (at(1).x + at(1).y)) << "soil is darker than sand";
  EXPECT_GT(at(4).z, at(4).x) << "ice is blue";
  for (int i = 0; i < 5; ++i) EXPECT_GT(glm::length(at(5)), glm::length(at(i))) << "snow is bright";
}

TEST_F(LandscapePicture, TriplanarWeightsSumToOne) {
  // A white ball whose surface is projected along three axes is as bright as one in a plain color.
  const TriangleMesh plain = test::sphere(4);
  TriangleMesh projected = plain;
  projected.shares.assign(projected.positions.size(), MaterialShares{255});
  TriangleMesh speck = strips(1);  // makes both scenes landscapes
  for (Vec3f& p : speck.positions) p *= 0.01f;
  const std::vector<SurfaceLook> white = {{.color = Vec3f(0.6f)}};
  const auto picture = [&](const TriangleMesh& ball) {
    return render_picture({.meshes = {{.mesh = &ball, .color = Vec3f(0.6f)},
                                      {.mesh = &speck, .origin = {0, 0, -0.5}}},
                           .surfaces = white},
                          {.width = 200, .height = 200});
  };
  EXPECT_LT(changes(picture(projected), picture(plain), 6).size(), 200u);
}

TEST_F(LandscapePicture, ImagesReplaceThePattern) {
  const TriangleMesh mesh = strips(2);
  RenderScene scene = {.meshes = {{.mesh = &mesh}},
                       .surfaces = {{.images = plain_images({180, 20, 20, 128})},
                                    {.images = plain_images({20, 20, 180, 128})}}};
  const Image image = render_picture(scene, from_above());
  const Vec3 west = mean(image, strip_middle(0, 2), 20), east = mean(image, strip_middle(1, 2), 20);
  EXPECT_GT(west.x, 2 * west.z);
  EXPECT_GT(east.z, 2 * east.x);
}

TEST_F(LandscapePicture, NormalMapsTiltTheLight) {
  const TriangleMesh mesh = strips(1);
  auto tilted = std::make_shared<SurfaceImages>(*plain_images({150, 150, 150, 128}));
  const auto picture = [&](std::uint8_t x, double sun_azimuth_deg) {
    tilted->normal = {.width = 1, .height = 1, .channels = 3, .pixels = {x, 128, 200}};
    ViewParams params = from_above();
    params.sun_azimuth_deg = sun_azimuth_deg;
    return brightness(
        render_picture({.meshes = {{.mesh = &mesh}}, .surfaces = {{.images = tilted}}}, params),
        192, 192);
  };
  EXPECT_GT(picture(220, 90), picture(36, 90) + 20) << "facing east, lit from the east";
  EXPECT_LT(picture(220, 270), picture(36, 270) - 20) << "facing east, lit from the west";
}

TEST_F(LandscapePicture, HigherMaterialShowsFirst) {
  TriangleMesh mesh = strips(1);
  mesh.shares.assign(mesh.positions.size(), MaterialShares{128, 127});
  const auto picture = [&](std::uint8_t red_height, std::uint8_t blue_height) {
    return mean(render_picture({.meshes = {{.mesh = &mesh}},
                                .surfaces = {{.images = plain_images({180, 20, 20, red_height})},
                                             {.images = plain_images({20, 20, 180, blue_height})}}},
                               from_above()),
                {192, 192}, 20);
  };
  const Vec3 red = picture(200, 60), blue = picture(60, 200), mixed = picture(128, 128);
  EXPECT_GT(red.x, 1.5 * red.z);
  EXPECT_GT(blue.z, 1.5 * blue.x);
  EXPECT_LT(std::abs(mixed.x - mixed.z), 0.3 * mixed.x);
}

TEST_F(LandscapePicture, RefusesWrongSurfaces) {
  TriangleMesh mesh = strips(1);
  auto images = std::make_shared<SurfaceImages>(*plain_images({1, 2, 3, 4}));
  images->albedo.width = 2;
  EXPECT_THROW(
      render_picture({.meshes = {{.mesh = &mesh}}, .surfaces = {{.images = images}}}, from_above()),
      Error);
  images->albedo.width = 1;
  images->size = 0;
  EXPECT_THROW(
      render_picture({.meshes = {{.mesh = &mesh}}, .surfaces = {{.images = images}}}, from_above()),
      Error);
  mesh.shares.pop_back();
  EXPECT_THROW(render_picture({.meshes = {{.mesh = &mesh}}}, from_above()), Error);
}

TEST_F(LandscapePicture, EmptyMeshesLeaveNoTrace) {
  const TriangleMesh mesh = strips(2), nothing;
  RenderScene scene = {.meshes = {{.mesh = &mesh}},
                       .surfaces = {{.pattern = SurfaceLook::Pattern::rock}}};
  const Image alone = render_picture(scene, from_above());
  scene.meshes.insert(scene.meshes.begin(), {.mesh = &nothing, .origin = {90, 0, 0}});
  scene.meshes.push_back({.mesh = &nothing});
  scene.water = {{.mesh = &nothing}};
  EXPECT_EQ(render_picture(scene, from_above()).pixels, alone.pixels);
}

TEST_F(LandscapePicture, DeepWaterIsBluerThanShallow) {
  TriangleMesh bed = strips(1);  // slopes down to the east
  for (Vec3f& p : bed.positions) p.z = -0.75f * (p.x + 4);
  TriangleMesh sheet = strips(1);
  sheet.shares.clear();
  for (Vec3f& p : sheet.positions) p.z = 0.3f;
  RenderScene scene = {.meshes = {{.mesh = &bed}},
                       .surfaces = {{.pattern = SurfaceLook::Pattern::sand}},
                       .water = {{.mesh = &sheet}}};
  const Image wet = render_picture(scene, from_above());
  scene.water.clear();
  const Image dry = render_picture(scene, from_above());
  const auto redness = [](const Image& image, int x) {
    const Vec3 c = mean(image, {x, 192}, 10);
    return c.x / (c.z + 1);
  };
  EXPECT_LT(redness(wet, 270), 0.7 * redness(dry, 270));
  EXPECT_LT(redness(wet, 270), 0.8 * redness(wet, 110));
}

TEST_F(LandscapePicture, SkyHasNoSeamOppositeTheSun) {
  TriangleMesh speck = strips(1);
  for (Vec3f& p : speck.positions) p *= 0.01f;
  for (const double azimuth : {0.0, 37.0, 132.0}) {
    ViewParams params = from_above();
    params.eye = Vec3(0, 0, 0);
    params.target = -Vec3(compass_direction(azimuth, -5));
    params.sun_azimuth_deg = azimuth;
    params.field_of_view_deg = 60;
    const Image image =
        render_picture({.meshes = {{.mesh = &speck, .origin = {0, 0, -9}}}}, params);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        ASSERT_GT(test::pixel(image, x, y).z, 40) << azimuth << ": " << x << ' ' << y;
  }
}

// All of one landscape, so that its mesh is made once.
TEST_F(LandscapePicture, MountainLooksAsItShould) {
  const test::Landscape land(120);
  const TriangleMesh mesh = land.mesh(72);
  InstanceTable stones = {{std::make_shared<TriangleMesh>(test::stone(1, 1))}, {}};
  for (int i = 0; i < 40; ++i) {
    const double y = 3.0 * i, x = 120 * (0.5 + 0.09 * std::sin(7 * y / 120));
    stones.instances.push_back({.position = {x, y, land.height(x, y)}, .scale = 1.5f});
  }
  using P = SurfaceLook::Pattern;
  RenderScene scene = {
      .stones = &stones,
      .meshes = {{.mesh = &mesh}},
      .surfaces = {
          {.pattern = P::rock}, {.pattern = P::sand}, {.pattern = P::soil}, {.pattern = P::snow}}};
  const ViewParams inside = {.width = 320,
                             .height = 180,
                             .field_of_view_deg = 70,
                             .eye = Vec3(45, 60, 12.6),
                             .target = Vec3(59, 60, 13.2)};
  const Image first = render_picture(scene, inside);

  // Equal input gives equal bytes.
  EXPECT_EQ(first.pixels, render_picture(scene, inside).pixels);

  // Pieces of a mesh in its own order are culled; in a far-flung order each piece spans the scene
  // and none is. Neither changes a pixel.
  TriangleMesh scattered = mesh;
  const std::size_t n = mesh.triangles.size();
  std::size_t stride = n / 2 + 1;
  while (std::gcd(stride, n) != 1) ++stride;
  for (std::size_t i = 0; i < n; ++i) scattered.triangles[i] = mesh.triangles[i * stride % n];
  scene.meshes = {{.mesh = &scattered}};
  EXPECT_EQ(first.pixels, render_picture(scene, inside).pixels);
  scene.meshes = {{.mesh = &mesh}};

  // A cave is dark for eyes that come from the day, and brighter for those that got used to it.
  ViewParams wall = inside;
  wall.eye = Vec3(50, 60, 12.8);
  wall.target = Vec3(40, 60, 12.8);
  const double unused = test::brightness(render_picture(scene, wall), 160, 90);
  wall.camera = CameraPreset::inside;
  const double used = test::brightness(render_picture(scene, wall), 160, 90);
  EXPECT_LT(unused, 220);
  EXPECT_GT(used, 1.3 * unused);

  // From the ground, land below and sky above.
  const Image low = render_picture(scene, {.camera = CameraPreset::low,
                                           .width = 320,
                                           .height = 180,
                                           .azimuth_deg = 180,
                                           .field_of_view_deg = 50});
  int sky = 0;
  for (int x = 0; x < 320; ++x) {
    const glm::ivec3 top = test::pixel(low, x, 2), bottom = test::pixel(low, x, 177);
    sky += top.z > top.x + 15;
    EXPECT_FALSE(bottom.z > bottom.x + 60) << x;
  }
  EXPECT_GT(sky, 60);
}

}  // namespace
}  // namespace talus
