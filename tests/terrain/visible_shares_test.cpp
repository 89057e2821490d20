#include "talus/terrain/visible_shares.h"

#include <gtest/gtest.h>

#include <numeric>

#include "terrain/stacks.h"

namespace talus {
namespace {

using test::random_stacks;

constexpr TerrainGrid kGrid{.nx = 6, .ny = 6, .cell = 0.7, .step = 0.1};

double overlap(double a, double b, double low, double high) {
  return std::max(0.0, std::min(b, high) - std::max(a, low));
}

// Face by face of all steps of all columns.
VisibleShares::Areas brute_force(const LayeredTerrain& terrain, MaterialSet materials, Vec3 g,
                                 double sigma) {
  const TerrainGrid& grid = terrain.grid();
  const Vec3 half(sigma / grid.cell, sigma / grid.cell, sigma / grid.step);
  const Vec3 size(grid.cell, grid.cell, grid.step);
  const auto at = [&](const Int3& v) {
    return terrain.material(std::clamp(v.x, 0, grid.nx - 1), std::clamp(v.y, 0, grid.ny - 1), v.z);
  };
  VisibleShares::Areas areas{};
  for (int z = -40; z < 120; ++z)
    for (int y = -6; y < grid.ny + 6; ++y)
      for (int x = -6; x < grid.nx + 6; ++x)
        for (int axis = 0; axis < 3; ++axis) {
          // The face between a step and the next along the axis.
          const Int3 low(x, y, z);
          Int3 high = low;
          ++high[axis];
          if (!(high[axis] > g[axis] - half[axis] && high[axis] < g[axis] + half[axis])) continue;
          const Material a = at(low), b = at(high);
          if (materials.contains(a) == materials.contains(b)) continue;
          double area = 1;
          for (int other = 0; other < 3; ++other)
            if (other != axis)
              area *= size[other] * overlap(low[other], low[other] + 1, g[other] - half[other],
                                            g[other] + half[other]);
          areas[static_cast<std::size_t>(materials.contains(a) ? a : b)] += area;
        }
  return areas;
}

TEST(VisibleShares, AreasEqualTheFacesOfAllSteps) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const LayeredTerrain terrain = random_stacks(seed, kGrid);
    const double sigma = uniform(hash(seed, Purpose::texture, 3), 0.2, 1.6);
    const MaterialSet materials =
        seed % 2 == 0 ? kGroundMaterials : MaterialSet{Material::sand, Material::rocks};
    const TerrainField field(terrain, materials, sigma);
    FieldSampler sampler(field);
    VisibleShares shares(sampler);
    for (int i = 0; i < 5; ++i) {
      const auto random = [&](int k, double low, double high) {
        return uniform(hash(seed, Purpose::texture, i, k), low, high);
      };
      const Vec3 g(random(0, -1, 7), random(1, -1, 7), random(2, -5, 60));
      const VisibleShares::Areas expected = brute_force(terrain, materials, g, sigma);
      const VisibleShares::Areas& areas = shares.areas(g);
      for (std::size_t m = 0; m < areas.size(); ++m) ASSERT_NEAR(areas[m], expected[m], 1e-12);

      // In 255ths, rounded by less than one, without loss.
      const MaterialShares rounded = shares.at(g);
      const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
      ASSERT_EQ(std::accumulate(rounded.begin(), rounded.end(), 0), 255);
      for (std::size_t m = 0; m < rounded.size() && total > 0; ++m)
        ASSERT_LT(std::abs(rounded[m] - 255 * expected[m] / total), 1);
    }
  }
}

TEST(VisibleShares, TellSandBesideSoilUnderWater) {
  LayeredTerrain terrain({.nx = 8, .ny = 8, .cell = 1, .step = 0.01});
  terrain.edit([](int x, int, ColumnEditor& column) {
    column.replace(0, 10, x < 4 ? Material::sand : Material::soil);
    column.replace(10, 200, Material::water);
  });
  const TerrainField field(terrain);
  FieldSampler sampler(field);
  VisibleShares shares(sampler);
  const auto share = [&](double x, Material m) {
    return shares.at({x, 4, 10})[static_cast<std::size_t>(m)];
  };
  EXPECT_EQ(share(2, Material::sand), 255);
  EXPECT_EQ(share(4, Material::sand), 128);
  EXPECT_EQ(share(4, Material::soil), 127);
  EXPECT_EQ(share(4.5, Material::soil), 191);
  EXPECT_EQ(share(6, Material::soil), 255);
}

TEST(VisibleShares, WhereNothingShowsTheNearestLayerDoes) {
  LayeredTerrain terrain({.nx = 4, .ny = 4, .cell = 1, .step = 0.01});
  terrain.edit([](int, int, ColumnEditor& column) {
    column.replace(0, 1000, Material::sand);
    column.replace(1000, 2000, Material::rocks);
    column.replace(2000, 3000, Material::soil);
  });
  const TerrainField field(terrain);
  FieldSampler sampler(field);
  VisibleShares shares(sampler);
  const auto shown = [&](double z, Material m) {
    return shares.at({2.3, 1.9, z})[static_cast<std::size_t>(m)] == 255;
  };
  EXPECT_TRUE(shown(-5000, Material::bedrock));
  EXPECT_TRUE(shown(500, Material::sand));
  EXPECT_TRUE(shown(1300, Material::sand));
  EXPECT_TRUE(shown(1700, Material::soil));
  EXPECT_TRUE(shown(9000, Material::soil));
}

}  // namespace
}  // namespace talus
