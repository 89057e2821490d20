#include "talus/tools/cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "talus/base/angle.h"
#include "talus/field/shape.h"
#include "talus/tools/fill_support.h"
#include "talus/tools/set_surface.h"

namespace talus {
namespace {

// A plane that rises to the east by that angle.
LayeredTerrain slope(double degrees) {
  HeightGrid heights{.nx = 40, .ny = 40, .cell = 0.5};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      heights.heights.push_back(static_cast<float>(0.5 * x * tan_deg(degrees)));
  return make_terrain(heights);
}

TEST(Cover, LiesFullOnLevelGroundAndNotOnSteep) {
  LayeredTerrain level = slope(0), gentle = slope(10), steep = slope(35);
  const CoverParams params{.material = Material::sand, .thickness = 0.25};  // rests up to 33 deg
  EXPECT_EQ(cover(level, params, 1).added(Material::sand), 40 * 40 * 250);
  EXPECT_GT(cover(gentle, params, 1).added(Material::sand), 40 * 40 * 240);
  const LayeredTerrain before = steep;
  cover(steep, params, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) EXPECT_EQ(steep.column(x, y).size(), before.column(x, y).size());
}

TEST(Cover, NeverExceedsTheAirUnderARoof) {
  LayeredTerrain terrain = slope(0);
  fill_support(terrain, ShapeSupport(Box{.center = {10, 10, -0.5}, .size = {8, 8, 0.2}}), {}, 1);
  LayeredTerrain sky_only = terrain;
  cover(terrain, {.material = Material::snow, .thickness = 0.5}, 1);
  EXPECT_EQ(terrain.material(20, 20, -450), Material::snow);
  EXPECT_EQ(terrain.material(20, 20, -399), Material::bedrock);
  EXPECT_EQ(terrain.material(20, 20, 499), Material::snow);

  cover(sky_only, {.material = Material::snow, .thickness = 0.5, .under_roofs = false}, 1);
  EXPECT_EQ(sky_only.material(20, 20, -450), Material::air);
}

TEST(Cover, KeepsToItsHeightsAndItsShare) {
  LayeredTerrain terrain = slope(20);
  cover(terrain, {.material = Material::soil, .from_height = 3}, 1);
  for (int x = 1; x < 39; ++x)
    EXPECT_EQ(terrain.column(x, 20).size(), 0.5 * x * tan_deg(20) < 3 ? 1u : 2u) << x;

  for (const double share : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    LayeredTerrain patchy = slope(0);
    cover(patchy,
          {.material = Material::soil, .thickness = 0.2, .patch_size = 0.7, .coverage = share}, 1);
    int covered = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        covered += patchy.material(x, y, 100) == Material::soil;  // at least half as thick
    EXPECT_NEAR(covered / 1600.0, share, 0.06) << share;
  }
}

TEST(Cover, TakesTheEndsOfItsLimits) {
  const LayeredTerrain steep = slope(60);
  LayeredTerrain any = steep, none = steep, frozen = steep;
  EXPECT_EQ(cover(any, {.thickness = 0.1, .slope_max_deg = 90}, 1).added(Material::sand),
            40 * 40 * 100);
  EXPECT_EQ(cover(none, {.thickness = 0.1, .slope_max_deg = 0}, 1), Booking());
  EXPECT_GT(cover(frozen, {.material = Material::ice}, 1).added(Material::ice), 0);
}

TEST(Cover, LeavesWaterOpen) {
  LayeredTerrain terrain = slope(0);
  terrain.edit([](int, int, ColumnEditor& column) { column.replace(0, 300, Material::water); });
  EXPECT_EQ(cover(terrain, {.material = Material::snow}, 1), Booking());
}

TEST(Cover, GoesAroundRocksUpToTheirFoot) {
  LayeredTerrain terrain = slope(0);
  const ColumnArea heap{5, 10, 15, 20}, ledge{25, 10, 35, 20};
  terrain.edit(heap,
               [](int, int, ColumnEditor& column) { column.replace(0, 3000, Material::rocks); });
  terrain.edit(ledge, [](int, int, ColumnEditor& column) {
    column.replace(0, 500, Material::rocks);
    column.replace(2000, 2500, Material::bedrock);
  });
  const LayeredTerrain before = terrain;
  const Booking booking = cover(terrain, {.material = Material::snow, .thickness = 0.5}, 1);

  // It is as thick beside the heap as anywhere.
  EXPECT_EQ(booking.removed(Material::rocks), 0);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      if (heap.contains(x, y))
        EXPECT_EQ(terrain.column(x, y).size(), before.column(x, y).size()) << x << " " << y;
      else if (ledge.contains(x, y))
        EXPECT_EQ(terrain.material(x, y, 500), Material::air) << x << " " << y;
      else
        EXPECT_EQ(terrain.material(x, y, 499), Material::snow) << x << " " << y;
    }
  EXPECT_EQ(terrain.material(30, 15, 2999), Material::snow);
}

}  // namespace
}  // namespace talus
