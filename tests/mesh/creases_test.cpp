#include "talus/mesh/creases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/shapes.h"

namespace talus {
namespace {

TEST(Creases, ACubeGetsTheNormalsOfItsFaces) {
  const TriangleMesh cube = test::unit_cube();
  const TriangleMesh creased = with_creased_normals(cube, 60);
  EXPECT_EQ(creased.positions.size(), 24u);
  ASSERT_EQ(creased.triangles.size(), cube.triangles.size());
  for (std::size_t t = 0; t < cube.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = creased.triangles[t][c];
      EXPECT_EQ(creased.positions[v], cube.positions[cube.triangles[t][c]]);
      const Vec3f p = creased.positions[v], n = creased.normals[v];
      EXPECT_FLOAT_EQ(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1);
      EXPECT_GT(glm::dot(n, p - Vec3f(0.5f)), 0) << "outward";
    }
  EXPECT_EQ(with_creased_normals(cube, 100).positions.size(), 8u) << "there is no crease";
}

// A roof of two slopes that meet in a ridge along y, as sheets of two triangles.
TriangleMesh roof(double turn_deg) {
  const auto fall = static_cast<float>(std::tan(0.5 * turn_deg * 0.017453292519943295));
  TriangleMesh mesh;
  mesh.positions = {{-1, 0, -fall}, {0, 0, 0}, {1, 0, -fall},
                    {-1, 1, -fall}, {0, 1, 0}, {1, 1, -fall}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  mesh.shares.resize(6);
  mesh.shares[4][2] = 255;
  return mesh;
}

TEST(Creases, BreakWhereFacesTurnByMoreThanTheAngle) {
  EXPECT_EQ(with_creased_normals(roof(59), 60).positions.size(), 6u);
  const TriangleMesh broken = with_creased_normals(roof(61), 60);
  EXPECT_EQ(broken.positions.size(), 8u);
  int kept = 0;
  for (std::size_t v = 0; v < 8; ++v)
    if (broken.positions[v] == Vec3f(0, 1, 0)) kept += broken.shares[v][2] == 255;
  EXPECT_EQ(kept, 2) << "both copies show what the vertex showed";
}

TEST(Creases, TinyTrianglesDoNotShow) {
  TriangleMesh mesh = roof(0);
  // One stands upright at an end of the ridge.
  mesh.positions.emplace_back(0, 1e-3f, 0);
  mesh.positions.emplace_back(0, 0, 1e-3f);
  mesh.triangles = {{0, 1, 6}, {0, 6, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {6, 1, 7}};
  mesh.shares.resize(8);
  const TriangleMesh creased = with_creased_normals(mesh, 100);
  for (std::size_t v = 0; v < creased.positions.size(); ++v)
    EXPECT_TRUE(creased.positions[v].z > 0 || creased.normals[v].z > 0.999f) << v;
}

TEST(Creases, TrianglesThatFaceOppositeWaysAreApart) {
  TriangleMesh mesh = roof(0);
  std::swap(mesh.triangles[2].x, mesh.triangles[2].y);
  std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
  const TriangleMesh creased = with_creased_normals(mesh, 60);
  EXPECT_EQ(creased.positions.size(), 8u);
  for (const Vec3f& n : creased.normals) EXPECT_FLOAT_EQ(std::abs(n.z), 1);
}

}  // namespace
}  // namespace talus
