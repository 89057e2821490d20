#include "talus/tools/erode_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "tools/brush_scene.h"

namespace talus {
namespace {

using namespace test;

TEST(ErodeSurface, TakesDepthTimesAmountInItsMiddleAndLessTowardItsRim) {
  LayeredTerrain terrain = gallery();
  const double radius = 1.5;  // the gallery's floor is out of reach
  const Booking booking = erode_surface(terrain, {.points = {{kMiddle, {}}}},
                                        {.depth = 0.8, .amount = 0.5, .brush = {.radius = radius}});
  std::int64_t eroded = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x) {
      const double r = glm::length(axis(x, y) - kMiddle) / radius;
      const double lost = r < 1 ? 0.4 * std::pow(1 - r * r, 2) : 0;
      const auto column = terrain.column(x, y);
      const bool sandy = column.back().material() == Material::sand;
      const Steps sand = sandy ? 0 - column[column.size() - 2].top() : 0;
      ASSERT_EQ(column.back().top(), 0) << "nothing moves";
      ASSERT_NEAR(sand, 1000 * lost, 0.5001) << x << ", " << y;
      ASSERT_EQ(terrain.material(x, y, -3001), Material::bedrock);
      eroded += sand;
    }
  EXPECT_GT(eroded, 1000);
  EXPECT_EQ(booking.replaced(Material::bedrock, Material::sand), eroded);
}

TEST(ErodeSurface, AlsoReachesFloorsUnderRoofsWithinTheBall) {
  LayeredTerrain terrain = gallery();
  erode_surface(terrain, {.points = {{kMiddle, -3}}}, {.depth = 0.3, .brush = {.radius = 2.5}});
  EXPECT_EQ(terrain.material(40, 32, -3001), Material::sand);
  EXPECT_EQ(terrain.material(40, 32, -2000), Material::bedrock) << "no underside";
  EXPECT_EQ(terrain.material(40, 32, -1), Material::bedrock) << "3 m above";
}

TEST(ErodeSurface, TurnsOnlyOpenBedrockNearTheStrokeAndBooksItOnAnyGround) {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const LayeredTerrain before = stacks(seed);
    LayeredTerrain after = before;
    const ErodeSurfaceParams params{.depth = 0.7, .brush = {.radius = 4}};
    const BrushRegion region = random_stroke(seed);
    const Booking booking = erode_surface(after, region, params);
    expect_booked(before, after, booking);
    EXPECT_EQ(booking.conversion(Material::bedrock, Material::sand).to_steps,
              booking.change()[index(Material::sand)]);
    expect_well_formed(after);
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x) {
        if (std::ranges::equal(before.column(x, y), after.column(x, y))) continue;
        ++changed;
        ASSERT_LE(distance_to_stroke(region, axis(x, y)), params.brush.radius);
        // Downward from the air: what turned to sand was the upper end of bedrock.
        for (Steps z = 16000; z >= kGrid.floor; z -= 31) {
          const Material then = before.material(x, y, z), now = after.material(x, y, z);
          if (then == now) continue;
          ASSERT_EQ(then, Material::bedrock);
          ASSERT_EQ(now, Material::sand);
          Steps top = z;
          while (before.material(x, y, top) == Material::bedrock) ++top;
          ASSERT_EQ(before.material(x, y, top), Material::air);
          ASSERT_LE(top - z, 700);
        }
      }
  }
  EXPECT_GT(changed, 2000);
}

TEST(ErodeSurface, OverItsOwnSandChangesNothing) {
  LayeredTerrain terrain = gallery();
  const BrushRegion region{.points = {{kMiddle, {}}, {Vec2(30, 20), {}}}};
  const ErodeSurfaceParams params{.depth = 0.5, .brush = {.radius = 1.5}};
  EXPECT_NE(erode_surface(terrain, region, params), Booking());
  EXPECT_EQ(erode_surface(terrain, region, params), Booking());
}

TEST(ErodeSurface, OfNoAmountOrDepthChangesNothing) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const LayeredTerrain before = stacks(seed);
    LayeredTerrain terrain = before;
    erode_surface(terrain, random_stroke(seed), {.depth = 0});
    erode_surface(terrain, random_stroke(seed), {.depth = 1, .amount = 0});
    EXPECT_TRUE(terrain == before);
  }
}

TEST(ErodeSurface, WithAMaskAloneWorksEverywhereAsItSays) {
  LayeredTerrain terrain = gallery();
  ColumnMask mask{.nx = kGrid.nx, .ny = kGrid.ny};
  for (int i = 0; i < kGrid.nx * kGrid.ny; ++i)
    mask.shares.push_back(static_cast<float>(pick(5, i, 3)) / 2);
  erode_surface(terrain, {.mask = mask}, {.depth = 0.4});
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x) {
      const Steps lost = 200 * pick(5, y * kGrid.nx + x, 3);
      for (const Steps surface : {0, -3000}) {
        ASSERT_EQ(terrain.material(x, y, surface - lost - 1), Material::bedrock);
        ASSERT_EQ(terrain.material(x, y, surface - 1),
                  lost > 0 ? Material::sand : Material::bedrock);
      }
    }
}

TEST(ErodeSurface, IsTheSameForAnyNumberOfThreads) {
  LayeredTerrain terrains[] = {stacks(1), stacks(1)};
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    erode_surface(terrains[threads - 1], random_stroke(4), {.depth = 1});
  }
  EXPECT_TRUE(terrains[0] == terrains[1]);
  EXPECT_FALSE(terrains[0] == stacks(1));
}

TEST(ErodeSurface, RefusesWhatItCannotDoAndChangesNothing) {
  LayeredTerrain terrain = gallery();
  const auto line = [&](const BrushRegion& region, const ErodeSurfaceParams& params) {
    try {
      erode_surface(terrain, region, params);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(line({}, {}), "erode_surface.points is empty, and there is no mask; give one of them");
  EXPECT_EQ(line({.points = {{kMiddle, {}}}}, {.amount = 1.5}),
            "erode_surface.amount = 1.5 is out of range; it must be from 0 to 1");
  EXPECT_EQ(line({.points = {{{-1, 2}, {}}}}, {}),
            "erode_surface.points: (-1, 2) is outside the terrain, which reaches from (0, 0) to "
            "(45, 35)");
  EXPECT_EQ(line({.mask = ColumnMask{}}, {}),
            "erode_surface.mask has 0 x 0 pixels; it must have one for each column of the terrain, "
            "90 x 70");
  EXPECT_TRUE(terrain == gallery());
}

}  // namespace
}  // namespace talus
