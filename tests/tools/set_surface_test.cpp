#include "talus/tools/set_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::vector<Layer> layers_of(const LayeredTerrain& terrain, int x, int y) {
  const auto span = terrain.column(x, y);
  return {span.begin(), span.end()};
}

// One column with a cave from 2 m to 3 m under a roof to 4 m, sand on top to 5 m.
LayeredTerrain cave() {
  LayeredTerrain terrain({.nx = 1, .ny = 1, .cell = 1});
  terrain.edit([](int, int, ColumnEditor& column) {
    column.replace(0, 2000, Material::bedrock);
    column.replace(3000, 4000, Material::bedrock);
    column.replace(4000, 5000, Material::sand);
  });
  return terrain;
}

HeightGrid level(float height) { return {.nx = 1, .ny = 1, .cell = 1, .heights = {height}}; }

TEST(SetSurface, SetFillsBelowAndClearsAbove) {
  LayeredTerrain terrain = cave();
  const Booking booking = set_surface(terrain, level(4.5f));
  EXPECT_EQ(layers_of(terrain, 0, 0),
            (std::vector<Layer>{{Material::bedrock, 4000}, {Material::sand, 4500}}));
  EXPECT_EQ(booking.added(Material::bedrock), 1000);
  EXPECT_EQ(booking.removed(Material::sand), 500);
}

TEST(SetSurface, RaiseFillsOnlyTheOpenAir) {
  LayeredTerrain terrain = cave();
  set_surface(terrain, level(6), {.change = SurfaceChange::raise, .material = Material::snow});
  EXPECT_EQ(layers_of(terrain, 0, 0), (std::vector<Layer>{{Material::bedrock, 2000},
                                                          {Material::air, 3000},
                                                          {Material::bedrock, 4000},
                                                          {Material::sand, 5000},
                                                          {Material::snow, 6000}}));
  LayeredTerrain unchanged = cave();
  set_surface(unchanged, level(1), {.change = SurfaceChange::raise});
  EXPECT_EQ(unchanged, cave());
}

TEST(SetSurface, LowerOnlyTakesAway) {
  LayeredTerrain terrain = cave();
  set_surface(terrain, level(2.5f), {.change = SurfaceChange::lower});
  EXPECT_EQ(layers_of(terrain, 0, 0), (std::vector<Layer>{{Material::bedrock, 2000}}));
  LayeredTerrain unchanged = cave();
  set_surface(unchanged, level(9), {.change = SurfaceChange::lower});
  EXPECT_EQ(unchanged, cave());
}

TEST(SetSurface, UnknownAndMissingCellsKeepTheirColumns) {
  LayeredTerrain terrain({.nx = 3, .ny = 1, .cell = 1});
  set_surface(terrain, {.nx = 2, .ny = 1, .cell = 1, .heights = {1, kUnknown}});
  EXPECT_EQ(terrain.column(0, 0).size(), 1u);
  EXPECT_TRUE(terrain.column(1, 0).empty());
  EXPECT_TRUE(terrain.column(2, 0).empty());
}

TEST(SetSurface, RefusesCellsOfAnotherSize) {
  LayeredTerrain terrain({.nx = 1, .ny = 1, .cell = 2});
  EXPECT_THROW(set_surface(terrain, level(1)), Error);
}

TEST(MakeTerrain, ReachesEachHeightToTheStepAboveAFloorThatLeavesRoom) {
  HeightGrid heights{.nx = 40, .ny = 30, .cell = 2.5};
  for (int i = 0; i < 40 * 30; ++i)
    heights.heights.push_back(i == 77 ? kUnknown : 1234.5f + 0.731f * static_cast<float>(i % 57));
  const LayeredTerrain terrain = make_terrain(heights);
  EXPECT_NEAR(terrain.grid().floor * terrain.grid().step, 1234.5 - 10, 0.002);
  for (int y = 0; y < heights.ny; ++y)
    for (int x = 0; x < heights.nx; ++x) {
      const auto column = terrain.column(x, y);
      const float height = heights.heights[heights.index(x, y)];
      if (std::isnan(height)) {
        EXPECT_TRUE(column.empty());
      } else {
        ASSERT_EQ(column.size(), 1u);
        EXPECT_NEAR(terrain.height_of(column[0].top()), height, 0.5001 * terrain.grid().step);
      }
    }
}

TEST(MakeTerrain, RefusesHeightsThatStepsCannotCount) {
  EXPECT_THROW(make_terrain(level(90'000)), Error);
  EXPECT_THROW(make_terrain(level(kUnknown)), Error);
  EXPECT_NO_THROW(make_terrain(level(90'000), 0.01));
}

}  // namespace
}  // namespace talus
