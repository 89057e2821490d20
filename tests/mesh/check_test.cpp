#include "talus/mesh/check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"

namespace talus {
namespace {

using test::unit_cube;

TEST(CheckMesh, FindsACubeSound) {
  const MeshCheck check = check_mesh(unit_cube());
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_TRUE(check.oriented());
  EXPECT_EQ(check.vertices, 8u);
  EXPECT_DOUBLE_EQ(signed_volume(unit_cube()), 1);
}

TEST(CheckMesh, SeesAMissingTriangle) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.pop_back();
  EXPECT_EQ(check_mesh(mesh).boundary_edges, 3u);
  EXPECT_FALSE(check_mesh(mesh).closed());
}

TEST(CheckMesh, SeesAFlippedTriangle) {
  TriangleMesh mesh = unit_cube();
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);
  EXPECT_EQ(check_mesh(mesh).misoriented_edges, 3u);
}

TEST(CheckMesh, SeesAThirdTriangleOnAnEdge) {
  TriangleMesh mesh = unit_cube();
  mesh.positions.emplace_back(0.5f, -1.0f, -1.0f);
  mesh.triangles.emplace_back(0, 1, 8);
  EXPECT_EQ(check_mesh(mesh).non_manifold_edges, 1u);
}

TEST(CheckMesh, SeesTwoSolidsThatShareOneVertex) {
  TriangleMesh mesh = unit_cube();
  const TriangleMesh other = unit_cube();
  for (const Vec3f& p : other.positions) mesh.positions.push_back(p + Vec3f(1));
  for (const Triangle& t : other.triangles) mesh.triangles.push_back(t + 8u);
  const MeshCheck check = check_mesh(mesh);
  EXPECT_EQ(check.vertices, 15u);
  EXPECT_EQ(check.non_manifold_vertices, 1u);
  EXPECT_EQ(check.non_manifold_edges, 0u);
}

TEST(CheckMesh, TellsSolidsThatTouchFromTornOnes) {
  TriangleMesh mesh = unit_cube();
  const TriangleMesh other = unit_cube();
  for (const Vec3f& p : other.positions) mesh.positions.push_back(p + Vec3f(1, 1, 0));
  for (const Triangle& t : other.triangles) mesh.triangles.push_back(t + 8u);
  EXPECT_EQ(check_mesh(mesh).non_manifold_edges, 1u);
  EXPECT_TRUE(check_mesh(mesh).bounds_solids());
  mesh.triangles.pop_back();
  EXPECT_FALSE(check_mesh(mesh).bounds_solids());
}

TEST(CheckMesh, JoinsVerticesSplitAtSeams) {
  TriangleMesh split;
  for (const Triangle& t : unit_cube().triangles)
    for (int c = 0; c < 3; ++c) {
      split.positions.push_back(unit_cube().positions[t[c]]);
      if (c == 2) {
        const auto last = static_cast<std::uint32_t>(split.positions.size() - 1);
        split.triangles.emplace_back(last - 2, last - 1, last);
      }
    }
  EXPECT_TRUE(check_mesh(split).closed());
  EXPECT_EQ(check_mesh(split).vertices, 8u);
}

TEST(CheckMesh, CountsDegenerateTriangles) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.emplace_back(0, 0, 1);
  EXPECT_EQ(check_mesh(mesh).degenerate, 1u);
  EXPECT_TRUE(check_mesh(mesh).closed());
}

TEST(Normals, PointOutOfACubesCorners) {
  TriangleMesh mesh = unit_cube();
  compute_normals(mesh);
  const float third = 1 / std::sqrt(3.0f);
  EXPECT_NEAR(mesh.normals[7].x, third, 1e-6f);
  EXPECT_NEAR(mesh.normals[7].y, third, 1e-6f);
  EXPECT_NEAR(mesh.normals[7].z, third, 1e-6f);
}

}  // namespace
}  // namespace talus
