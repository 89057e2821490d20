#include "talus/field/mesh_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "field/blocks.h"
#include "field/meshes.h"
#include "mesh/shapes.h"
#include "talus/base/hash.h"
#include "talus/field/winding_number.h"

namespace talus {
namespace {

using test::icosphere;
using test::joined;

Vec3 random_point(const Box3& box, int i) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = uniform(hash(31, Purpose::texture, i, axis), box.min[axis], box.max[axis]);
  return p;
}

double exact_winding(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = Vec3(mesh.positions[t.x]) - p, b = Vec3(mesh.positions[t.y]) - p,
               c = Vec3(mesh.positions[t.z]) - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

// A sphere with noise, so that no direction is special.
TriangleMesh lump(int levels) {
  TriangleMesh m = icosphere(levels);
  for (std::size_t i = 0; i < m.positions.size(); ++i)
    m.positions[i] *= static_cast<float>(uniform(hash(1, Purpose::texture, i), 0.85, 1.15));
  return m;
}

void expect_inside_is_that_of_the_winding_number(const TriangleMesh& mesh, int points) {
  const MeshSupport support(mesh);
  int differences = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3 p = random_point(support.bounds().expanded(0.05), i);
    differences += support.contains(p) != (std::abs(exact_winding(mesh, p)) > 0.5);
  }
  EXPECT_EQ(differences, 0);
}

TEST(MeshSupport, ClosedMeshesAreExact) {
  expect_inside_is_that_of_the_winding_number(lump(3), 5000);
  expect_inside_is_that_of_the_winding_number(test::unit_cube(), 5000);
}

TEST(MeshSupport, MeshesThatCrossThemselvesAreExact) {
  expect_inside_is_that_of_the_winding_number(joined(lump(2), lump(2), Vec3f(0.9f, 0.2f, 0.1f)),
                                              3000);
}

// Rows of the grid run exactly through the corner in the middle, which has the highest index of its
// fan but one.
TEST(MeshSupport, LinesThroughVerticesAreExact) {
  TriangleMesh mesh;
  mesh.positions = {{0, 12.5f, 12.5f}, {24, 12.5f, 12.5f}, {12, 0, 12},
                    {12, 24, 12},      {12, 12, 0},        {12, 12, 24}};
  mesh.triangles = {{0, 2, 5}, {2, 1, 5}, {1, 3, 5}, {3, 0, 5},
                    {2, 0, 4}, {1, 2, 4}, {3, 1, 4}, {0, 3, 4}};
  for (int rotation = 0; rotation < 6; ++rotation) {
    const MeshSupport support(mesh);
    EXPECT_TRUE(support.contains({12, 12.3, 12.4}));
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = random_point(support.bounds(), i);
      ASSERT_EQ(support.contains(p), std::abs(exact_winding(mesh, p)) > 0.5);
    }
    // The same solid with its vertices numbered from another one on.
    std::rotate(mesh.positions.begin(), mesh.positions.begin() + 1, mesh.positions.end());
    for (Triangle& t : mesh.triangles) t = (t + 5u) % 6u;
  }
}

TriangleMesh box_from(double z_low, double z_high) {
  TriangleMesh box = test::unit_cube();
  for (Vec3f& p : box.positions) p = {4 * p.x, 4 * p.y, p.z > 0 ? z_high : z_low};
  return box;
}

TEST(MeshSupport, SolidsThatShareAWallAreOneSolid) {
  const MeshSupport tower(
      joined(joined(box_from(0, 1), box_from(1.5, 2.5), Vec3f(0)), box_from(1, 1.5), Vec3f(0)));
  EXPECT_NEAR(tower.report().volume, 40, 1e-6);
  for (const double z : {0.5, 1.1, 1.4, 2.0}) EXPECT_TRUE(tower.contains({2, 2, z})) << z;
}

TEST(MeshSupport, ASurfaceDrawnFromBothSidesIsOneSurface) {
  TriangleMesh twice = lump(3);
  const std::vector<Triangle> front = twice.triangles;
  for (const Triangle& t : front) twice.triangles.emplace_back(t.x, t.z, t.y);
  const MeshSupport support(twice), reference(lump(3));
  EXPECT_EQ(support.report().duplicates, front.size());
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(reference.bounds(), i);
    ASSERT_EQ(support.contains(p), reference.contains(p));
  }
}

TEST(MeshSupport, AThinPlateIsASolid) {
  TriangleMesh plate = test::unit_cube();
  for (Vec3f& p : plate.positions) p *= Vec3f(20, 20, 0.2f);
  const MeshSupport support(plate);
  EXPECT_NEAR(support.report().volume, 80, 1e-3);
  EXPECT_TRUE(support.contains({10.01, 10.02, 0.1}));
  EXPECT_FALSE(support.contains({10.01, 10.02, 0.3}));
}

TEST(MeshSupport, TellsOfOverlaps) {
  EXPECT_FALSE(MeshSupport(lump(3)).report().overlapping);
  EXPECT_TRUE(MeshSupport(joined(lump(3), lump(3), Vec3f(0.5f, 0.2f, 0.1f))).report().overlapping);
}

TEST(MeshSupport, ASoupOfLargeTrianglesEndsSoon) {
  TriangleMesh soup;
  for (int i = 0; i < 60000; ++i) {
    const Vec3 p = random_point({Vec3(0), Vec3(1)}, i);
    soup.positions.emplace_back(p);
    if (i % 3 == 2) {
      const auto last = static_cast<std::uint32_t>(i);
      soup.triangles.emplace_back(last - 2, last - 1, last);
    }
  }
  Job job;
  job.cancel();
  EXPECT_THROW(MeshSupport(soup, &job), Cancelled);
}

TEST(MeshSupport, ACavityIsOutside) {
  TriangleMesh inner = icosphere(2);
  for (Vec3f& p : inner.positions) p *= 0.5f;
  for (Triangle& t : inner.triangles) std::swap(t.y, t.z);
  const MeshSupport shell(joined(icosphere(3), inner, Vec3f(0)));
  EXPECT_FALSE(shell.contains(Vec3(0)));
  EXPECT_TRUE(shell.contains(Vec3(0.75, 0, 0)));
}

TEST(MeshSupport, VolumeIsEnclosedOne) {
  EXPECT_NEAR(MeshSupport(icosphere(4)).report().volume, 4.0 / 3 * std::numbers::pi, 0.04);
  EXPECT_NEAR(MeshSupport(test::unit_cube()).report().volume, 1, 0.01);
}

TEST(MeshSupport, AnInvertedMeshIsTurned) {
  TriangleMesh mesh = lump(3);
  for (Triangle& t : mesh.triangles) std::swap(t.y, t.z);
  const MeshSupport support(mesh);
  EXPECT_TRUE(support.report().inverted);
  EXPECT_TRUE(support.contains(Vec3(0.1, 0.2, 0)));
  EXPECT_FALSE(support.contains(Vec3(0.9, 0.9, 0.9)));
}

TEST(MeshSupport, FlippedFacesAreTurned) {
  const TriangleMesh good = lump(3);
  TriangleMesh mesh = good;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 7)
    std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  const MeshSupport support(mesh), reference(good);
  EXPECT_EQ(support.report().flipped, (mesh.triangles.size() + 6) / 7);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random_point(support.bounds(), i);
    ASSERT_EQ(support.contains(p), reference.contains(p));
  }
}

TEST(MeshSupport, AHoleHardlyChangesTheInside) {
  const TriangleMesh whole = lump(4);
  TriangleMesh torn = whole;
  std::erase_if(torn.triangles, [&](const Triangle& t) { return torn.positions[t.x].z < -0.9f; });
  const MeshSupport support(torn), reference(whole);
  EXPECT_GT(support.report().boundary_edges, 10u);
  int differences = 0;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = random_point(reference.bounds(), i);
    differences += support.contains(p) != reference.contains(p);
  }
  EXPECT_LT(differences, kPoints / 200);
  EXPECT_NEAR(support.report().volume, reference.report().volume, 0.1);
}

TEST(MeshSupport, ClassifiedBoxesAnswerAlikeEverywhere) {
  TriangleMesh torn = lump(3);
  torn.triangles.resize(torn.triangles.size() - 20);
  for (const TriangleMesh& mesh : {lump(3), torn}) {
    const MeshSupport support(mesh);
    int inside = 0, outside = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 center = random_point(support.bounds().expanded(0.2), i);
      const Box3 box{center - 0.06, center + 0.06};
      const BoxState state = support.classify(box);
      inside += state == BoxState::inside;
      outside += state == BoxState::outside;
      if (state == BoxState::mixed) continue;
      for (int k = 0; k < 10; ++k)
        ASSERT_EQ(support.contains(random_point(box, 10 * i + k)), state == BoxState::inside);
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 100);
  }
}

TEST(MeshSupport, BlocksAnswerAsPointsAndBoxesDo) {
  TriangleMesh torn = lump(4);
  torn.triangles.resize(torn.triangles.size() - 300);
  for (const TriangleMesh& mesh : {lump(4), torn, box_from(0, 1)}) {
    const MeshSupport support(mesh);
    for (int i = 0; i < 2000; ++i)
      test::expect_answers_as_for_one(support,
                                      test::random_block(support.bounds().expanded(0.1), i), i);
  }
}

TEST(MeshSupport, FarFromTheOriginNothingChanges) {
  TriangleMesh mesh = icosphere(3);
  for (Vec3f& p : mesh.positions) p = p * 16.0f + Vec3f(65536, -65536, 4096);
  const MeshSupport support(mesh);
  EXPECT_TRUE(support.contains({65536, -65536, 4096}));
  EXPECT_FALSE(support.contains({65536 + 16.5, -65536, 4096}));
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    MeshSupport support(mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "";
}

TEST(MeshSupport, RefusesMeshesWithoutAnInside) {
  const std::string no_volume =
      "the mesh encloses no volume; give a closed surface, or one with small holes only";
  EXPECT_EQ(refusal({}), "the mesh has no triangles");
  EXPECT_EQ(refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}}), no_volume);
  EXPECT_EQ(refusal({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {{0, 1, 2}}}), no_volume);
  TriangleMesh flat = test::unit_cube();
  for (Vec3f& p : flat.positions) p.z = 0;
  EXPECT_EQ(refusal(flat), no_volume);
  TriangleMesh bad = test::unit_cube();
  bad.positions[3].y = NAN;
  EXPECT_EQ(refusal(bad), "the mesh has a vertex whose coordinates are not finite");
  bad = test::unit_cube();
  bad.triangles[0].x = 8;
  EXPECT_EQ(refusal(bad), "the mesh has a triangle with vertex 8, but only 8 vertices");
}

TEST(WindingNumber, DipolesErrByLittle) {
  TriangleMesh mesh = lump(4);
  mesh.triangles.resize(mesh.triangles.size() * 3 / 4);
  std::vector<std::array<Vec3, 3>> soup;
  for (const Triangle& t : mesh.triangles)
    soup.push_back(
        {Vec3(mesh.positions[t.x]), Vec3(mesh.positions[t.y]), Vec3(mesh.positions[t.z])});
  const WindingNumber number(soup);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point({Vec3(-1.5), Vec3(1.5)}, i);
    ASSERT_NEAR(number.at(p), exact_winding(mesh, p), 0.02);
  }
}

}  // namespace
}  // namespace talus
