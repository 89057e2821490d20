#include "talus/terrain/terrain_field.h"

#include <gtest/gtest.h>

#include "talus/terrain/field_sampler.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::pick;
using test::random_stacks;

constexpr double kExact = 1e-14;

constexpr TerrainGrid kGrid{
    .nx = 6, .ny = 5, .cell = 0.7, .step = 0.1, .origin_x = 3, .origin_y = -2, .floor = 4};

// A random number in [low, high).
double random(std::uint64_t seed, int k, double low, double high) {
  return uniform(hash(seed, Purpose::texture, k), low, high);
}

// Around the columns, beyond their border, above and below.
Vec3 random_point(std::uint64_t seed) {
  return {random(seed, 1, 2, 8.2), random(seed, 2, -3, 2.5), random(seed, 3, -1, 8)};
}

constexpr MaterialSet kSets[] = {kGroundMaterials,
                                 {Material::rocks},
                                 {Material::air, Material::water},
                                 {Material::bedrock, Material::snow, Material::rocks}};

double overlap(double a, double b, double low, double high) {
  return std::max(0.0, std::min(b, high) - std::max(a, low));
}

// Sum over all steps of all columns, those of the border repeated outward.
double brute_force(const LayeredTerrain& terrain, MaterialSet materials, double sigma,
                   const Vec3& p) {
  const TerrainGrid& grid = terrain.grid();
  double volume = 0;
  for (int y = -10; y < grid.ny + 10; ++y)
    for (int x = -10; x < grid.nx + 10; ++x) {
      const double west = grid.origin_x + x * grid.cell, south = grid.origin_y + y * grid.cell;
      const double area = overlap(west, west + grid.cell, p.x - sigma, p.x + sigma) *
                          overlap(south, south + grid.cell, p.y - sigma, p.y + sigma);
      if (area == 0) continue;
      for (Steps z = -40; z < 140; ++z)
        if (materials.contains(
                terrain.material(std::clamp(x, 0, grid.nx - 1), std::clamp(y, 0, grid.ny - 1), z)))
          volume += area * overlap(z * grid.step, (z + 1) * grid.step, p.z - sigma, p.z + sigma);
    }
  return 2 * volume / (8 * sigma * sigma * sigma) - 1;
}

TEST(TerrainField, IsOneInsideMinusOneOutsideZeroOnLevelGround) {
  LayeredTerrain terrain({.nx = 8, .ny = 8, .cell = 2, .step = 0.01});
  terrain.edit([](int, int, ColumnEditor& column) {
    column.replace(0, 300, Material::sand);
    column.replace(300, 500, Material::water);
  });
  const TerrainField field(terrain);
  EXPECT_EQ(field.sigma(), 2);
  for (const Vec3 at : {Vec3(8, 8, 0), Vec3(3.3, 12.1, 0), Vec3(-40, 300, 0)}) {
    const auto value = [&](double z) { return field.value(at + Vec3(0, 0, z)); };
    EXPECT_NEAR(value(3), 0, kExact);
    EXPECT_NEAR(value(1), 1, kExact);
    EXPECT_NEAR(value(-1000), 1, kExact);
    EXPECT_NEAR(value(5), -1, kExact);
    EXPECT_NEAR(value(1e6), -1, kExact);
    EXPECT_NEAR(value(2), 0.5, kExact);
    const TerrainField water(terrain, {Material::water});
    EXPECT_NEAR(water.value(at + Vec3(0, 0, 4)), 0, kExact);
    EXPECT_NEAR(water.value(at + Vec3(0, 0, 1)), -1, kExact);
  }
}

TEST(TerrainField, EqualsTheVolumeStepByStep) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LayeredTerrain terrain = random_stacks(seed, kGrid);
    const double sigma = random(seed, 4, 0.2, 2.2);
    const MaterialSet materials = kSets[seed % std::size(kSets)];
    const TerrainField field(terrain, materials, sigma);
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Vec3 p = random_point(100 * seed + i);
      ASSERT_NEAR(field.value(p), brute_force(terrain, materials, sigma, p), 1e-12);
    }
  }
}

TEST(TerrainField, GradientIsTheSlopeOfTheValue) {
  constexpr double kStep = 1e-5;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LayeredTerrain terrain = random_stacks(seed, kGrid);
    const TerrainField field(terrain, kSets[seed % std::size(kSets)], random(seed, 4, 0.2, 2.2));
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Vec3 p = random_point(100 * seed + i), gradient = field.gradient(p);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 step(0);
        step[axis] = kStep;
        ASSERT_NEAR(gradient[axis], (field.value(p + step) - field.value(p - step)) / (2 * kStep),
                    1e-5);
      }
    }
  }
}

// At places where a face of the cube lies between columns the slope differs on both sides.
TEST(TerrainField, GradientBetweenColumnsIsTheMeanOfBothSides) {
  const LayeredTerrain terrain =
      random_stacks(5, {.nx = 6, .ny = 6, .cell = 1, .step = 0.125}, 9, 20);
  const TerrainField field(terrain);
  constexpr double kStep = 1e-5;
  for (int x = 1; x < 6; ++x)
    for (int y = 1; y < 6; ++y) {
      const Vec3 p(x, y, 0.75 * x + 0.3 * y);
      for (int axis = 0; axis < 2; ++axis) {
        Vec3 step(0);
        step[axis] = kStep;
        ASSERT_NEAR(field.gradient(p)[axis],
                    (field.value(p + step) - field.value(p - step)) / (2 * kStep), 1e-5);
      }
    }
}

TEST(TerrainField, RefusesAKernelOutOfRange) {
  const LayeredTerrain terrain({.nx = 3, .ny = 3, .cell = 0.5});
  EXPECT_THROW(TerrainField(terrain, kGroundMaterials, 0.0), Error);
  EXPECT_THROW(TerrainField(terrain, kGroundMaterials, -1.0), Error);
  EXPECT_THROW(TerrainField(terrain, kGroundMaterials, 33.0), Error);
}

TEST(FieldSampler, AnswersAlikeWhateverIsLoaded) {
  const LayeredTerrain terrain = random_stacks(7, kGrid);
  const TerrainField field(terrain);
  FieldSampler wide(field), narrow(field);
  wide.load({-9, -9, 20, 20});
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Vec3 p = random_point(i), g = field.grid_from_world(p);
    ASSERT_EQ(wide.value(g), field.value(p));
    ASSERT_EQ(narrow.value(g), field.value(p));
    ASSERT_EQ(wide.gradient(g), narrow.gradient(g));
  }
}

TEST(FieldSampler, VerticalsCrossWhereTheSignChanges) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const LayeredTerrain terrain = random_stacks(seed, kGrid);
    const MaterialSet materials = kSets[seed % std::size(kSets)];
    const TerrainField field(terrain, materials, random(seed, 4, 0.2, 2.2));
    FieldSampler sampler(field);
    const Vec3 g = field.grid_from_world(random_point(seed));
    const std::span<const double> found = sampler.vertical_crossings(g.x, g.y);
    const std::vector<double> crossings(found.begin(), found.end());
    for (const double z : crossings) ASSERT_NEAR(sampler.value({g.x, g.y, z}), 0, 1e-8);
    bool inside = materials.contains(Material::bedrock);
    std::size_t next = 0;
    for (double z = -40; z < 140; z += 0.173) {
      for (; next < crossings.size() && crossings[next] < z; ++next) inside = !inside;
      ASSERT_EQ(sampler.value({g.x, g.y, z}) > kInsideAbove, inside) << seed << " at " << z;
    }
    ASSERT_EQ(next, crossings.size());
  }
}

TEST(FieldSampler, HorizontalsCrossAtTheFirstChangeOfSign) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const LayeredTerrain terrain = random_stacks(seed, kGrid);
    const TerrainField field(terrain, kGroundMaterials, random(seed, 4, 0.2, 2.2));
    FieldSampler sampler(field);
    const Vec3 g = field.grid_from_world(random_point(seed));
    const int axis = pick(seed, 5, 2);
    const double length = random(seed, 6, 0.3, 4);
    const double share = sampler.horizontal_crossing(g, axis, length);
    const auto value = [&](double s) {
      Vec3 p = g;
      p[axis] += s * length;
      return sampler.value(p);
    };
    const bool inside = value(0) > kInsideAbove;
    constexpr int kParts = 500;
    int changed = 1;
    while (changed <= kParts && (value(1.0 * changed / kParts) > kInsideAbove) == inside) ++changed;
    if (changed <= kParts) {
      // A change and its reverse between two parts go unseen here.
      ASSERT_LE(share, 1.0 * changed / kParts + 1e-9);
      ASSERT_NEAR(value(share), 0, 1e-8);
    } else if (share == 0 || share == 1) {
      ASSERT_LE(std::abs(value(share)), std::abs(value(1 - share)) + 1e-9);
    } else {
      ASSERT_NEAR(value(share), 0, 1e-8);
    }
  }
}

// Along a cliff between two columns f is 0 for all its height.
TEST(FieldSampler, WallsThatHalveTheCubeAreOutside) {
  LayeredTerrain terrain({.nx = 8, .ny = 8, .cell = 0.3, .step = 0.001});
  terrain.edit([](int x, int, ColumnEditor& column) {
    if (x < 4) column.replace(0, 40'000, Material::bedrock);
  });
  const TerrainField field(terrain);
  FieldSampler sampler(field);
  const std::span<const double> crossings = sampler.vertical_crossings(4, 4);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(crossings[0], 300, 0.001);
}

}  // namespace
}  // namespace talus
