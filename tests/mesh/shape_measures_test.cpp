#include "talus/mesh/shape_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "talus/mesh/polygonize.h"
#include "tests/mesh/shapes.h"

namespace talus {
namespace {

glm::dmat3 test_turn() { return glm::mat3_cast(glm::normalize(glm::dquat(0.7, 0.3, -0.5, 0.2))); }

// Stretched, turned and moved.
TriangleMesh placed(TriangleMesh mesh, const Vec3& size) {
  const glm::dmat3 turn = test_turn();
  for (Vec3f& p : mesh.positions) p = Vec3f(turn * (Vec3(p) * size) + Vec3(5, -3, 11));
  return mesh;
}

// A ball of unit radius about the origin.
TriangleMesh ball() {
  constexpr int kSide = 42;
  std::vector<float> field;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        field.push_back(static_cast<float>(19.5 - glm::length(Vec3(x, y, z) - 0.5 * (kSide - 1))));
  PolygonizeScratch scratch;
  TriangleMesh mesh = polygonize({Int3(kSide), field}, scratch);
  for (Vec3f& p : mesh.positions) p = (p - 0.5f * (kSide - 1)) / 19.5f;
  return mesh;
}

TEST(ShapeMeasures, OfABrickAreItsEdgesFaceAreasAndVolume) {
  const ShapeMeasures m = measure_shape(placed(test::unit_cube(), {1, 3, 2}));
  EXPECT_NEAR(m.volume, 6, 1e-4);
  EXPECT_NEAR(m.area, 22, 1e-4);
  EXPECT_NEAR(m.lengths.x, 3, 1e-5);
  EXPECT_NEAR(m.lengths.y, 2, 1e-5);
  EXPECT_NEAR(m.lengths.z, 1, 1e-5);
  EXPECT_NEAR(glm::determinant(m.axes), 1, 1e-9);
  const glm::dmat3 turn = test_turn();
  for (const auto& [axis, edge] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    EXPECT_NEAR(std::abs(glm::dot(m.axes[axis], turn[edge])), 1, 1e-6) << axis;
  EXPECT_NEAR(m.equivalent_diameter(), std::cbrt(36 / std::numbers::pi), 1e-5);
}

TEST(ShapeMeasures, OfAnEllipsoidAreItsAxes) {
  const ShapeMeasures m = measure_shape(placed(ball(), {0.5, 2, 1}));
  EXPECT_NEAR(m.volume, 4.0 / 3 * std::numbers::pi, 0.01 * m.volume);
  EXPECT_NEAR(m.lengths.x, 4, 0.02);
  EXPECT_NEAR(m.lengths.y, 2, 0.02);
  EXPECT_NEAR(m.lengths.z, 1, 0.02);
}

TEST(ShapeMeasures, SphericityIsOneForABallAndKnownForACube) {
  EXPECT_NEAR(measure_shape(ball()).sphericity(), 1, 0.005);
  EXPECT_NEAR(measure_shape(test::unit_cube()).sphericity(), std::cbrt(std::numbers::pi / 6), 1e-9);
}

}  // namespace
}  // namespace talus
