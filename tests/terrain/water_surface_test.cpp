#include "talus/terrain/water_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "talus/base/parallel.h"
#include "talus/mesh/check.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::pick;
using test::random_stacks;
using Square = std::tuple<int, int, Steps>;  // column and height

bool is_open_water(const LayeredTerrain& terrain, int x, int y, Steps level) {
  const TerrainGrid& grid = terrain.grid();
  return x >= 0 && x < grid.nx && y >= 0 && y < grid.ny && level > grid.floor &&
         terrain.material(x, y, level - 1) == Material::water &&
         terrain.material(x, y, level) == Material::air;
}

std::set<Square> expected_squares(const LayeredTerrain& terrain, int reach, Steps highest) {
  std::set<Square> squares;
  for (int y = 0; y < terrain.grid().ny; ++y)
    for (int x = 0; x < terrain.grid().nx; ++x)
      for (Steps z = terrain.grid().floor; z <= highest; ++z) {
        if (is_open_water(terrain, x, y, z)) squares.insert({x, y, z});
        const Material below = terrain.material(x, y, z - 1);
        if (below == Material::air || below == Material::water) continue;
        for (int dy = -reach; dy <= reach; ++dy)
          for (int dx = -reach; dx <= reach; ++dx)
            if (is_open_water(terrain, x + dx, y + dy, z)) squares.insert({x, y, z});
      }
  return squares;
}

// The squares that a mesh's triangles make up; every square must have both.
std::set<Square> squares_of(const TriangleMesh& mesh, const TerrainGrid& grid, const Vec3& origin) {
  std::set<Square> squares;
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = Vec3(mesh.positions[t.x]), b = Vec3(mesh.positions[t.y]);
    const Vec3 c = Vec3(mesh.positions[t.z]);
    const Vec3 middle = (a + b + c) / 3.0 + origin;
    EXPECT_EQ(a.z, b.z);
    EXPECT_EQ(a.z, c.z);
    const double twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice_area, 0);
    area += twice_area / 2;
    squares.insert({grid.column_x(middle.x), grid.column_y(middle.y),
                    static_cast<Steps>(std::lround(middle.z / grid.step))});
  }
  EXPECT_NEAR(area, static_cast<double>(squares.size()) * grid.cell * grid.cell, 1e-3);
  EXPECT_EQ(mesh.triangles.size(), 2 * squares.size());
  return squares;
}

RC_GTEST_PROP(WaterSurface, CoversOpenWaterAndReachesUnderItsBanks, (std::uint64_t seed)) {
  const LayeredTerrain terrain = random_stacks(seed,
                                               {.nx = 1 + pick(seed, 0, 20),
                                                .ny = 1 + pick(seed, 1, 20),
                                                .cell = 0.5,
                                                .step = 0.25,
                                                .origin_x = 10,
                                                .origin_y = -3,
                                                .floor = -4},
                                               6, 4);
  const Vec3 origin(8, 1, 2);
  const TriangleMesh mesh = make_water_surface(terrain, origin);
  RC_ASSERT(squares_of(mesh, terrain.grid(), origin) == expected_squares(terrain, 1, 30));
  for (const int reach : {0, 3}) {
    const TriangleMesh other = make_water_surface(terrain, origin, {.bank = 0.5 * reach});
    RC_ASSERT(squares_of(other, terrain.grid(), origin) == expected_squares(terrain, reach, 30));
  }
  RC_ASSERT(joined_vertices(mesh).size() == mesh.positions.size());
  RC_ASSERT(check_mesh(mesh).vertices == mesh.positions.size());
  RC_ASSERT(check_mesh(mesh).oriented());
}

TEST(WaterSurface, APondIsOneSheetThatReachesUnderItsBank) {
  LayeredTerrain terrain({.nx = 20, .ny = 20});
  terrain.edit([](int x, int y, ColumnEditor& c) {
    const int dx = x - 10, dy = y - 10;
    c.replace(0, 50 + 8 * (dx * dx + dy * dy), Material::bedrock);
    c.replace(c.layers().back().top(), 200, Material::water);
  });
  const TriangleMesh mesh = make_water_surface(terrain, Vec3(0));
  EXPECT_TRUE(check_mesh(mesh).manifold());
  ASSERT_FALSE(mesh.positions.empty());
  for (const Vec3f& p : mesh.positions) ASSERT_EQ(p.z, 0.2f);
  for (const Vec3f& n : mesh.normals) ASSERT_EQ(n, Vec3f(0, 0, 1));
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(bounds(mesh).max.x, 16);  // water up to column 14, and the column behind it
}

TEST(WaterSurface, PoolsSideBySideKeepToThemselves) {
  const TerrainGrid grid{.nx = 8, .ny = 5};
  LayeredTerrain terrain(grid);
  terrain.edit([](int x, int y, ColumnEditor& c) {
    const bool pool = x > 0 && x < 7 && y > 0 && y < 4;
    c.replace(0, pool ? 5 : 50, Material::bedrock);
    if (pool) c.replace(5, x < 4 ? 30 : 20, Material::water);
  });
  // Each over its own columns and under the rock on three sides.
  std::set<Square> expected;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 8; ++x) expected.insert({x, y, x < 4 ? 30 : 20});
  for (const int y : {0, 4}) {
    expected.insert({4, y, 30});
    expected.insert({3, y, 20});
  }
  const TriangleMesh mesh = make_water_surface(terrain, Vec3(0));
  EXPECT_EQ(squares_of(mesh, grid, Vec3(0)), expected);
}

TEST(WaterSurface, WaterUnderIceOrBedrockHasNone) {
  LayeredTerrain terrain({.nx = 3, .ny = 3});
  terrain.edit([](int, int, ColumnEditor& c) {
    c.replace(0, 10, Material::water);
    c.replace(10, 12, Material::ice);
    c.replace(20, 30, Material::water);
    c.replace(30, 40, Material::bedrock);
  });
  EXPECT_TRUE(make_water_surface(terrain, Vec3(0)).triangles.empty());
}

TEST(WaterSurface, RefusesABankOutOfRange) {
  const LayeredTerrain terrain({.nx = 3, .ny = 3});
  EXPECT_THROW(make_water_surface(terrain, Vec3(0), {.bank = -1}), Error);
  EXPECT_THROW(make_water_surface(terrain, Vec3(0), {.bank = std::nan("")}), Error);
  const double widest = 64 * terrain.grid().cell;
  EXPECT_NO_THROW(make_water_surface(terrain, Vec3(0), {.bank = widest}));
  EXPECT_THROW(make_water_surface(terrain, Vec3(0), {.bank = 1.001 * widest}), Error);
}

TEST(WaterSurface, IsTheSameForAnyNumberOfThreads) {
  const LayeredTerrain terrain = random_stacks(3, {.nx = 100, .ny = 90});
  const auto made_by = [&](int threads) {
    const ThreadLimit limit(threads);
    const TriangleMesh mesh = make_water_surface(terrain, Vec3(1, 2, 3));
    return std::pair(mesh.positions, mesh.triangles);
  };
  EXPECT_EQ(made_by(1), made_by(2));
}

}  // namespace
}  // namespace talus
