#include "talus/mesh/polygonize.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "talus/base/hash.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

struct Grid {
  Int3 size;
  std::vector<float> values;
  GridView view() const { return {size, values}; }
};

Grid sample(int n, auto&& value) {
  Grid grid{Int3(n), {}};
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) grid.values.push_back(value(x, y, z));
  return grid;
}

// Every sign pattern occurs in noise; the border is outside.
Grid noise(int n, int seed) {
  return sample(n, [&](int x, int y, int z) {
    const bool border = std::min({x, y, z}) == 0 || std::max({x, y, z}) == n - 1;
    const double u = uniform(hash(static_cast<std::uint64_t>(seed), Purpose::texture, x, y, z));
    return border ? -1.0f : static_cast<float>(2 * u - 1);
  });
}

TEST(Polygonize, SphereHasItsVolumeAndRadius) {
  constexpr double kRadius = 12.3;
  const Vec3 center(15.1, 14.7, 15.4);
  const Grid grid = sample(32, [&](int x, int y, int z) {
    return static_cast<float>(kRadius - glm::length(Vec3(x, y, z) - center));
  });
  PolygonizeScratch scratch;
  const TriangleMesh mesh = polygonize(grid.view(), scratch);
  // Chords of the sphere lose a share of about 1 / R^2 of its volume.
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  EXPECT_LT(signed_volume(mesh), volume);
  EXPECT_GT(signed_volume(mesh), volume * (1 - 1 / (kRadius * kRadius)));
  for (const Vec3f& p : mesh.positions) ASSERT_NEAR(glm::length(Vec3(p) - center), kRadius, 0.02);
}

// Samples saturate one sample away from the surface, as those of stones do.
TEST(Polygonize, NormalsFollowTheSurface) {
  const Vec3 center(11.1, 11.7, 11.4);
  const Grid grid = sample(24, [&](int x, int y, int z) {
    return static_cast<float>(std::clamp(8.3 - glm::length(Vec3(x, y, z) - center), -1.0, 1.0));
  });
  PolygonizeScratch scratch;
  const TriangleMesh mesh = polygonize(grid.view(), scratch);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  double least = 1;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    ASSERT_NEAR(glm::length(mesh.normals[i]), 1, 1e-5);
    least = std::min(
        least, glm::dot(Vec3(mesh.normals[i]), glm::normalize(Vec3(mesh.positions[i]) - center)));
  }
  EXPECT_GT(least, std::cos(5 * std::numbers::pi / 180))
      << std::acos(least) * 180 / std::numbers::pi;
}

TEST(Polygonize, NoiseGivesClosedManifoldOrientedMeshes) {
  PolygonizeScratch scratch;
  for (int seed = 0; seed < 20; ++seed) {
    const MeshCheck check = check_mesh(polygonize(noise(14, seed).view(), scratch));
    EXPECT_TRUE(check.closed());
    EXPECT_TRUE(check.oriented());
    EXPECT_TRUE(check.manifold());
    EXPECT_EQ(check.degenerate, 0u);
  }
}

// The signs 0 and 1 of a field and of its negative differ only in where diagonal corners join, so
// away from ambiguous faces the two surfaces are the same triangles, turned around.
TEST(Polygonize, ComplementIsTheSameSurfaceReversedWhereUnambiguous) {
  PolygonizeScratch scratch;
  Grid grid = sample(24, [](int x, int y, int z) {
    return static_cast<float>(7.3 - glm::length(Vec3(x, y, z) - Vec3(11.2, 11.6, 11.9)));
  });
  const TriangleMesh solid = polygonize(grid.view(), scratch);
  for (float& v : grid.values) v = -v;
  const TriangleMesh hollow = polygonize(grid.view(), scratch);
  ASSERT_EQ(solid.triangles.size(), hollow.triangles.size());
  const auto canonical = [](Triangle t, bool reverse) {
    if (reverse) std::swap(t.y, t.z);
    while (t.x > t.y || t.x > t.z) t = Triangle(t.y, t.z, t.x);
    return t;
  };
  for (std::size_t i = 0; i < solid.triangles.size(); ++i)
    EXPECT_EQ(canonical(solid.triangles[i], false), canonical(hollow.triangles[i], true));
}

// The segments of two disjoint positive sets on one cell face must not cross: both cut off corners.
TEST(Polygonize, SeparatesDiagonalPositivesOnAFace) {
  const Grid grid = sample(
      4, [](int x, int y, int z) { return z == 1 && x == y && (x == 1 || x == 2) ? 1.0f : -1.0f; });
  PolygonizeScratch scratch;
  const TriangleMesh mesh = polygonize(grid.view(), scratch);
  EXPECT_EQ(mesh.positions.size(), 12u);
  EXPECT_EQ(mesh.triangles.size(), 16u);  // two octahedra
}

TEST(Polygonize, NothingPositiveGivesNoTriangle) {
  PolygonizeScratch scratch;
  EXPECT_TRUE(
      polygonize(sample(5, [](int, int, int) { return 0.0f; }).view(), scratch).triangles.empty());
}

}  // namespace
}  // namespace talus
