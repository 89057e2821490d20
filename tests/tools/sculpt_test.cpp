#include "talus/tools/sculpt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "tools/ground.h"

namespace talus {
namespace {

constexpr TerrainGrid kGrid{.nx = 64, .ny = 48, .cell = 0.5, .step = 0.001, .floor = -40000};
constexpr Vec3 kMiddle(16.25, 12.25, 0);

LayeredTerrain flat() {
  return test::ground(kGrid, [](double, double) { return 0.0; });
}

// Random columns: caves, sand, water; neighbors differ by chance.
LayeredTerrain random_stacks(std::uint64_t seed) {
  LayeredTerrain terrain = test::ground(
      kGrid, [&](double x, double y) { return 2 * std::sin(x * 0.4) * std::cos(y * 0.3); });
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const auto draw = [&](int k, double low, double high) {
      return static_cast<Steps>(uniform(hash(seed, Purpose::texture, x / 3, y / 3, k), low, high));
    };
    const Steps cave = draw(0, -9000, -2000);
    column.replace(cave, cave + draw(1, -2000, 4000), Material::air);
    if (draw(2, 0, 4) == 1) column.replace(draw(3, -3000, 1000), draw(4, 0, 2000), Material::sand);
    if (draw(5, 0, 6) == 1) column.replace(1500, draw(6, 1500, 3000), Material::bedrock);
  });
  return terrain;
}

double top(const LayeredTerrain& terrain, int x, int y) {
  const auto column = terrain.column(x, y);
  return column.empty() ? terrain.height_of(terrain.grid().floor)
                        : terrain.height_of(column.back().top());
}
double top_at_middle(const LayeredTerrain& terrain) {
  return top(terrain, terrain.grid().column_x(kMiddle.x), terrain.grid().column_y(kMiddle.y));
}

Vec3 center_of(const TerrainGrid& grid, int x, int y, Steps z) {
  return {(x + 0.5) * grid.cell, (y + 0.5) * grid.cell, (z + 0.5) * grid.step};
}

TEST(Dab, MovesFlatGroundByItsHeight) {
  for (const bool carve : {false, true})
    for (const double radius : {2.0, 5.0, 9.3})
      for (const double share : {0.02, 0.1, 0.25}) {
        LayeredTerrain terrain = flat();
        const double height = share * radius;
        dab(terrain, kMiddle, {.radius = radius, .height = height, .carve = carve});
        EXPECT_NEAR(top_at_middle(terrain), carve ? -height : height, 0.02 * height + 0.002)
            << radius << " " << height;
      }
}

TEST(Dab, OfNoHeightChangesNothing) {
  for (int i = 0; i < 5; ++i) {
    const LayeredTerrain before = random_stacks(static_cast<std::uint64_t>(i));
    LayeredTerrain terrain = before;
    Booking booking = sculpt(terrain, {{Vec2(10, 10), {}}}, {.dab = {.radius = 6, .height = 0}});
    EXPECT_TRUE(terrain == before);
    EXPECT_EQ(booking.change(), MaterialSteps{});
  }
}

TEST(Dab, CanBeAsWideAsItMay) {
  LayeredTerrain terrain({.nx = 280, .ny = 280, .cell = 1, .floor = -100'000});
  dab(terrain, {140.5, 140.5, -100}, {.radius = kDabColumnsMax, .height = 8});
  EXPECT_NEAR(terrain.height_of(terrain.column(140, 140).back().top()), -92, 0.1);
}

TEST(Dab, ChangesNoStepFartherThanItsRadius) {
  for (const bool carve : {false, true}) {
    const LayeredTerrain before = flat();
    LayeredTerrain terrain = before;
    const double radius = 5;
    dab(terrain, kMiddle, {.radius = radius, .height = 1, .carve = carve});
    const Vec3 center = kMiddle + Vec3(0, 0, carve ? 0.5 * radius : -0.5 * radius);
    int changed = 0;
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x)
        for (Steps z = -4000; z < 4000; z += 10) {
          if (terrain.material(x, y, z) == before.material(x, y, z)) continue;
          ++changed;
          ASSERT_LE(glm::length(center_of(kGrid, x, y, z) - center), radius);
        }
    EXPECT_GT(changed, 1000);
  }
}

// On any ground: the surface is at most sigma from the point, the center R / 2 from the surface.
TEST(Dab, OnAnyGroundAddsOrTakesNearbyAndBooksIt) {
  int dabs = 0;
  for (int i = 0; i < 40; ++i) {
    const LayeredTerrain before = random_stacks(static_cast<std::uint64_t>(i));
    LayeredTerrain terrain = before;
    const bool carve = i % 2 == 0;
    const auto draw = [&](int k, double low, double high) {
      return uniform(hash(3, Purpose::texture, i, k), low, high);
    };
    const Vec2 at(draw(0, 1, 31), draw(1, 1, 23));
    const DabParams params{.radius = draw(2, 2, 7), .height = 0.4, .carve = carve};
    Booking booking;
    try {
      booking = sculpt(terrain, {{at, {}}}, {.dab = params});
    } catch (const Error&) {
      EXPECT_TRUE(terrain == before) << "the surface was too far away";
      continue;
    }
    ++dabs;
    const MaterialSteps was = before.volume(), is = terrain.volume(), booked = booking.change();
    for (std::size_t m = 0; m < is.size(); ++m) EXPECT_EQ(is[m] - was[m], booked[m]);
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x) {
        if (std::ranges::equal(terrain.column(x, y), before.column(x, y))) continue;
        ASSERT_LE(glm::length(Vec2(center_of(kGrid, x, y, 0)) - at), 2.1 * params.radius);
        for (Steps z = -12000; z < 12000; z += 97) {
          const Material now = terrain.material(x, y, z), then = before.material(x, y, z);
          if (now != then) {
            ASSERT_EQ(carve ? then : now, Material::bedrock);
          }
        }
      }
  }
  EXPECT_GT(dabs, 25);
}

TEST(Dab, KeepsWhatIsFinerThanItsField) {
  const auto bumps = [](double x, double y) {
    return 0.2 * (uniform(hash(1, Purpose::texture, std::lround(8 * x), std::lround(8 * y))) - 0.5);
  };
  LayeredTerrain plain = flat(), bumpy = test::ground(kGrid, bumps);
  const DabParams params{.radius = 6, .height = 1};
  dab(plain, kMiddle, params);
  dab(bumpy, kMiddle, params);
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      ASSERT_NEAR(top(bumpy, x, y) - top(plain, x, y),
                  bumps((x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell), 0.06);
}

TEST(Dab, AddedAndCarvedLeavesLittle) {
  LayeredTerrain terrain = flat();
  const DabParams params{.radius = 6, .height = 0.6};
  dab(terrain, kMiddle, params);
  DabParams back = params;
  back.carve = true;
  dab(terrain, kMiddle + Vec3(0, 0, params.height), back);
  double most = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x) most = std::max(most, std::abs(top(terrain, x, y)));
  EXPECT_LT(most, 0.4 * params.height);
}

// Walls thinner than the brush, on one side of which bedrock is added.
TEST(Dab, LeavesTheFarSideOfAThinWallAlone) {
  constexpr double kNear = 16;
  for (const double thickness : {1.5, 2.0, 3.0}) {
    const double far = kNear + thickness;
    const LayeredTerrain before =
        test::ground(kGrid, [&](double x, double) { return x > kNear && x < far ? 15.0 : -10.0; });
    LayeredTerrain terrain = before;
    dab(terrain, {kNear, 12.25, 2}, {.radius = 4, .height = 0.8});
    EXPECT_EQ(terrain.material(kGrid.column_x(kNear - 0.3), kGrid.column_y(12.25), 2000),
              Material::bedrock);
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x)
        if ((x + 0.5) * kGrid.cell > far) {
          ASSERT_TRUE(std::ranges::equal(terrain.column(x, y), before.column(x, y))) << x;
        }
  }
}

TEST(Sculpt, BuildsAnOverhangOnAWall) {
  LayeredTerrain terrain =
      test::ground(kGrid, [](double x, double) { return x < 14 ? 12.0 : -10.0; });
  // Dabs at one height pull the wall outward.
  std::vector<SurfacePoint> stroke;
  for (int i = 0; i < 4; ++i) stroke.push_back({{14 + 0.7 * i, 12.25}, 4.0});
  sculpt(terrain, stroke, {.dab = {.radius = 4, .height = 0.9}, .spacing = 0.15});
  const int x = kGrid.column_x(15.25), y = kGrid.column_y(12.25);
  EXPECT_EQ(terrain.material(x, y, 4000), Material::bedrock);
  EXPECT_EQ(terrain.material(x, y, -4000), Material::air) << "under the overhang";
  EXPECT_EQ(terrain.material(x, y, 11000), Material::air);
}

TEST(Sculpt, AFinerGridMovesTheSurfaceByLessThanACell) {
  TerrainGrid fine = kGrid;
  fine.nx *= 2;
  fine.ny *= 2;
  fine.cell /= 2;
  const auto hills = [](double x, double y) { return std::sin(0.3 * x) + std::sin(0.4 * y); };
  LayeredTerrain coarse = test::ground(kGrid, hills), doubled = test::ground(fine, hills);
  const StrokeParams params{.dab = {.radius = 5, .height = 0.7}};
  const std::vector<SurfacePoint> points{{{10, 10}, {}}, {{20, 14}, {}}};
  sculpt(coarse, points, params);
  sculpt(doubled, points, params);
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x) {
      double mean = 0;
      for (int k = 0; k < 4; ++k) mean += 0.25 * top(doubled, 2 * x + k % 2, 2 * y + k / 2);
      ASSERT_NEAR(top(coarse, x, y), mean, kGrid.cell);
    }
}

TEST(Sculpt, StrokesAreEvenAndEndWhereTheyShould) {
  LayeredTerrain terrain = flat();
  sculpt(terrain, {{{8, 12}, {}}, {{24, 12}, {}}}, {.dab = {.radius = 3, .height = 0.2}});
  const int y = kGrid.column_y(12);
  double low = 1e9, high = 0;
  for (int x = kGrid.column_x(12); x < kGrid.column_x(20); ++x) {
    low = std::min(low, top(terrain, x, y));
    high = std::max(high, top(terrain, x, y));
  }
  EXPECT_GT(low, 0.2);
  EXPECT_LT(high - low, 0.1 * high);
  EXPECT_EQ(top(terrain, kGrid.column_x(4.5), y), 0);
  EXPECT_EQ(top(terrain, kGrid.column_x(27.5), y), 0);
}

TEST(Sculpt, IsTheSameForAnyNumberOfThreads) {
  LayeredTerrain terrains[] = {random_stacks(7), random_stacks(7)};
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    sculpt(terrains[threads - 1], {{{8, 8}, {}}, {{24, 16}, {}}},
           {.dab = {.radius = 6, .height = 0.5}});
  }
  EXPECT_TRUE(terrains[0] == terrains[1]);
  EXPECT_FALSE(terrains[0] == random_stacks(7));
}

TEST(Sculpt, RefusesWhatItCannotDoAndChangesNothing) {
  const LayeredTerrain before = flat();
  LayeredTerrain terrain = before;
  const auto line = [&](const std::vector<SurfacePoint>& points, const StrokeParams& params) {
    try {
      sculpt(terrain, points, params);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const std::vector<SurfacePoint> middle{{Vec2(kMiddle), {}}};
  EXPECT_EQ(line({}, {}), "sculpt.points is empty; a stroke needs at least one");
  EXPECT_EQ(line(middle, {.dab = {.radius = 0.6, .height = 0.1}}),
            "sculpt.radius = 0.6 m is 1.2 columns of 0.5 m; it must be 2 to 128 columns");
  EXPECT_EQ(line(middle, {.dab = {.radius = 4, .height = 1.5}}),
            "sculpt.height = 1.5 m is more than a quarter of sculpt.radius = 4 m; use more dabs");
  EXPECT_EQ(line({{{8, 8}, {}}, {{50, 8}, {}}}, {}),
            "sculpt.points: (32, 8) is outside the terrain, which reaches from (0, 0) to (32, 24)");
  EXPECT_EQ(line({{{8, 8}, 9.0}}, {}),
            "sculpt.points: no bedrock's surface within 2.25 m of (8, 8, 9)");
  EXPECT_NE(line({{{8, 8}, {}}}, {.dab = {.radius = -1}}), "nothing");
  EXPECT_EQ(line({{{8, 8}, {}}, {{std::nan(""), 8}, {}}}, {}),
            "sculpt.points: a coordinate is no finite number");
  EXPECT_EQ(line({{{8, 8}, HUGE_VAL}}, {}), "sculpt.points: a coordinate is no finite number");
  EXPECT_TRUE(terrain == before);
}

}  // namespace
}  // namespace talus
