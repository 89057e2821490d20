#include "talus/tools/fill_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "field/meshes.h"
#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/field/mesh_support.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

constexpr TerrainGrid kGrid{
    .nx = 30, .ny = 26, .cell = 0.5, .step = 0.05, .origin_x = -3, .origin_y = 2, .floor = -100};

// A dented ball about (4, 8, 1), wider than the terrain reaches to the west.
TriangleMesh random_ball(std::uint64_t seed) {
  TriangleMesh ball = test::icosphere(3);
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    const double size = uniform(hash(seed, Purpose::texture, v), 4.5, 5.5);
    ball.positions[v] = Vec3f(size * Vec3(ball.positions[v]) + Vec3(1.52, 8.21, 1.03));
  }
  return ball;
}

void expect_as_asked(const LayeredTerrain& before, const LayeredTerrain& after,
                     const Support& inside, Material material, const MaterialSet& replaces) {
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      for (Steps z = kGrid.floor; z < 200; ++z) {
        const Vec3 center(kGrid.origin_x + (x + 0.5) * kGrid.cell,
                          kGrid.origin_y + (y + 0.5) * kGrid.cell, (z + 0.5) * kGrid.step);
        const Material old = before.material(x, y, z);
        const bool filled = inside.contains(center) && replaces.contains(old);
        ASSERT_EQ(after.material(x, y, z), filled ? material : old) << x << " " << y << " " << z;
      }
}

TEST(FillMesh, FillsExactlyTheStepsWhoseCentersLieWithinAndBooksThem) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const TriangleMesh ball = random_ball(seed);
    const LayeredTerrain before = test::random_stacks(seed, kGrid, 9, 30);
    const Material material = seed % 2 == 0 ? Material::air : Material::bedrock;
    const MaterialSet replaces =
        seed % 3 == 0 ? MaterialSet{Material::air, Material::sand} : kAllMaterials;
    LayeredTerrain terrain = before;
    const Booking booking = fill_mesh(terrain, ball, {material, replaces});
    expect_as_asked(before, terrain, MeshSupport(ball), material, replaces);
    test::expect_well_formed(terrain);
    EXPECT_EQ(test::sum(before.volume(), booking.change()), terrain.volume());
  }
}

// Axes that run through edges and vertices meet exactly one of the triangles around them.
TEST(FillMesh, MissesNothingBetweenTriangles) {
  const TerrainGrid grid{.nx = 20, .ny = 20, .cell = 1, .step = 0.1, .floor = -100};
  TriangleMesh block;  // corners and diagonals in the middle of columns
  for (const float z : {-2.0f, 3.0f})
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 4; ++x) block.positions.emplace_back(Vec3(2.5 + 2 * x, 2.5 + 2 * y, z));
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    block.triangles.emplace_back(a, b, c);
    block.triangles.emplace_back(a, c, d);
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      const std::uint32_t p = 5 * i + x;
      quad(p, p + 5, p + 6, p + 1);
      quad(p + 25, p + 26, p + 31, p + 30);
    }
    quad(i, i + 1, i + 26, i + 25);
    quad(i + 21, i + 20, i + 45, i + 46);
    quad(5 * i + 5, 5 * i, 5 * i + 25, 5 * i + 30);
    quad(5 * i + 4, 5 * i + 9, 5 * i + 34, 5 * i + 29);
  }
  LayeredTerrain terrain(grid);
  fill_mesh(terrain, block, {Material::bedrock});
  EXPECT_EQ(terrain.volume()[0], 8 * 8 * 50);
}

TEST(FillMesh, IsTheSameForAnyNumberOfThreads) {
  LayeredTerrain terrains[] = {LayeredTerrain(kGrid), LayeredTerrain(kGrid)};
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    fill_mesh(terrains[threads - 1], random_ball(1), {Material::soil});
  }
  EXPECT_EQ(terrains[0], terrains[1]);
  EXPECT_GT(terrains[0].volume()[static_cast<std::size_t>(Material::soil)], 0);
}

TEST(FillMesh, BesideTheTerrainChangesNothing) {
  const LayeredTerrain before = test::random_stacks(3, kGrid);
  TriangleMesh ball = random_ball(1);
  for (Vec3f& p : ball.positions) p.x += 100;
  LayeredTerrain terrain = before;
  fill_mesh(terrain, ball, {Material::air});
  EXPECT_EQ(terrain, before);
}

TEST(FillMesh, OfBallsThatOverlapInOneMeshFillsBoth) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const TriangleMesh ball = random_ball(seed), other = random_ball(seed + 10);
    TriangleMesh both = ball;
    const auto count = static_cast<std::uint32_t>(ball.positions.size());
    for (const Vec3f& p : other.positions) both.positions.push_back(p + Vec3f(2.7f, 1.1f, 0.4f));
    for (const Triangle& t : other.triangles) both.triangles.push_back(t + count);
    TriangleMesh moved = other;
    for (Vec3f& p : moved.positions) p += Vec3f(2.7f, 1.1f, 0.4f);
    LayeredTerrain together = test::random_stacks(seed, kGrid, 9, 30), apart = together;
    fill_mesh(together, both, {Material::sand});
    fill_mesh(apart, ball, {Material::sand});
    fill_mesh(apart, moved, {Material::sand});
    EXPECT_EQ(together, apart);
  }
}

TEST(FillMesh, RefusesWhatIsNoMeshAndChangesNothing) {
  const LayeredTerrain before = test::random_stacks(3, kGrid);
  LayeredTerrain terrain = before;
  const auto refuses = [&](auto&& spoil) {
    TriangleMesh ball = random_ball(1);
    spoil(ball);
    EXPECT_THROW(fill_mesh(terrain, ball, {Material::air}), Error);
  };
  refuses([](TriangleMesh& ball) { ball.positions[7].x = NAN; });
  refuses([](TriangleMesh& ball) { ball.positions[9].z = INFINITY; });
  refuses([](TriangleMesh& ball) { ball.triangles[3].y = 1u << 20; });
  EXPECT_EQ(terrain, before);
}

}  // namespace
}  // namespace talus
