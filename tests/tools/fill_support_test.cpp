#include "talus/tools/fill_support.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "field/meshes.h"
#include "talus/base/parallel.h"
#include "talus/field/mesh_support.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

constexpr TerrainGrid kGrid{.nx = 80, .ny = 60, .cell = 0.25, .step = 0.01, .floor = -1000};

LayeredTerrain flat() {
  LayeredTerrain terrain(kGrid);
  terrain.edit([](int, int, ColumnEditor& column) {
    column.replace(column.floor(), 500, Material::bedrock);
  });
  return terrain;
}

// Every step of every column, asked one by one.
void expect_as_asked(const LayeredTerrain& before, const LayeredTerrain& after,
                     const Support& support, const FillParams& params) {
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      for (Steps z = -50; z < 1200; ++z) {
        const Vec3 center((x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell, (z + 0.5) * kGrid.step);
        const Material old = before.material(x, y, z);
        const bool filled = support.contains(center) && params.replaces.contains(old);
        ASSERT_EQ(after.material(x, y, z), filled ? params.material : old)
            << x << " " << y << " " << z;
      }
}

TEST(FillSupport, FillsExactlyTheStepsWhoseCentersLieWithin) {
  const ShapeSupport shapes[] = {
      ShapeSupport(Sphere{.center = {10, 7, 5}, .radius = 3.1}),
      ShapeSupport(Box{.center = {10.1, 7.3, 4.2}, .size = {5, 4, 3}}),
      ShapeSupport(Capsule{.from = {3, 3, 2}, .to = {15, 11, 6}, .from_radius = 1}),
      ShapeSupport(Cylinder{.base = {19, 14, 1}, .radius = 4, .height = 7}),  // over the border
      ShapeSupport(HalfSpace{.point = {10, 7, 4}, .normal = {1, -2, 3}}),
  };
  for (const ShapeSupport& shape : shapes)
    for (const Material material : {Material::air, Material::sand}) {
      const FillParams params{.material = material};
      LayeredTerrain terrain = flat();
      fill_support(terrain, shape, params, 1);
      expect_as_asked(flat(), terrain, shape, params);
    }
}

// A mesh has no distances, only answers for boxes.
TEST(FillSupport, FillsMeshesAsItAsksThem) {
  TriangleMesh ball = test::icosphere(2);
  for (Vec3f& p : ball.positions) p = 3.0f * p + Vec3f(10.03f, 7.02f, 4.01f);
  const MeshSupport support(ball);
  const FillParams params{.material = Material::sand};
  LayeredTerrain terrain = flat(), rough = flat();
  fill_support(terrain, support, params, 1);
  expect_as_asked(flat(), terrain, support, params);

  const double radius = 3, roughness = 0.2;
  fill_support(rough, support, {.material = Material::sand, .roughness = roughness}, 1);
  EXPECT_FALSE(rough == terrain);
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      for (Steps z = 0; z < 900; z += 7) {
        const Vec3 center((x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell, (z + 0.5) * kGrid.step);
        const double from_middle = glm::length(center - Vec3(10.03, 7.02, 4.01));
        const bool sand = rough.material(x, y, z) == Material::sand;
        if (sand) {
          EXPECT_LT(from_middle, radius + roughness);
        } else {
          EXPECT_GT(from_middle, 0.96 * radius - roughness);
        }
      }
}

TEST(FillSupport, ReplacesOnlyWhatItMay) {
  const ShapeSupport sphere(Sphere{.center = {10, 7, 5}, .radius = 3});
  const FillParams params{.material = Material::sand, .replaces = {Material::air}};
  LayeredTerrain terrain = flat();
  const Booking booking = fill_support(terrain, sphere, params, 1);
  expect_as_asked(flat(), terrain, sphere, params);
  EXPECT_EQ(booking.replaced(Material::bedrock, Material::sand), 0);
}

TEST(FillSupport, BooksTheVolumeOfASphere) {
  LayeredTerrain terrain = flat();
  const double radius = 4;
  const Booking booking =
      fill_support(terrain, ShapeSupport(Sphere{.center = {10, 7, 0}, .radius = radius}),
                   {.material = Material::water}, 1);
  const double column = kGrid.cell * kGrid.cell * kGrid.step;
  const double volume =
      static_cast<double>(booking.replaced(Material::bedrock, Material::water)) * column;
  EXPECT_NEAR(volume / (4.0 / 3 * std::numbers::pi * radius * radius * radius), 1, 0.005);
}

TEST(FillSupport, RoughnessStaysWithinItsReachAndFollowsTheSeed) {
  const Sphere sphere{.center = {10, 7, 5}, .radius = 3};
  const FillParams params{.roughness = 0.4, .roughness_size = 1.5};
  LayeredTerrain rough = flat(), again = flat(), other = flat();
  fill_support(rough, ShapeSupport(sphere), params, 1);
  fill_support(again, ShapeSupport(sphere), params, 1);
  fill_support(other, ShapeSupport(sphere), params, 2);
  EXPECT_EQ(rough, again);
  EXPECT_FALSE(rough == other);

  const DistanceFunction to_sphere = distance_function(sphere);
  const double reach = params.roughness;
  int moved = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      for (Steps z = 0; z < 500; z += 7) {
        const Vec3 center((x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell, (z + 0.5) * kGrid.step);
        const double distance = to_sphere(center);
        const bool empty = rough.material(x, y, z) == Material::air;
        if (distance < -reach) {
          ASSERT_TRUE(empty);
        }
        if (distance > reach) {
          ASSERT_FALSE(empty);
        }
        moved += empty != (distance <= 0);
      }
  EXPECT_GT(moved, 500);
}

TEST(FillSupport, ThreadsDoNotShow) {
  const FillParams params{.material = Material::soil, .roughness = 0.3};
  const ShapeSupport shape(Capsule{.from = {3, 3, 2}, .to = {15, 11, 6}, .from_radius = 1});
  LayeredTerrain one = flat(), many = flat();
  {
    const ThreadLimit limit(1);
    fill_support(one, shape, params, 1);
  }
  fill_support(many, shape, params, 1);
  EXPECT_EQ(one, many);
}

}  // namespace
}  // namespace talus
