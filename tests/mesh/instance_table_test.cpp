#include "talus/mesh/instance_table.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "mesh/shapes.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

InstanceTable two_cubes() {
  return {
      {std::make_shared<TriangleMesh>(test::unit_cube())},
      {{.position = {10, 0, 0}, .scale = 2},
       {.position = {0, 5, 0}, .rotation = glm::angleAxis(glm::half_pi<float>(), Vec3f(0, 0, 1))}}};
}

TEST(InstanceTable, BoundsCoverEveryInstance) {
  const Box3 box = bounds(two_cubes());
  EXPECT_NEAR(box.min.x, -1, 1e-6);
  EXPECT_NEAR(box.max.x, 12, 1e-6);
  EXPECT_NEAR(box.max.y, 6, 1e-6);
  EXPECT_NEAR(box.max.z, 2, 1e-6);
}

TEST(InstanceTable, FlatteningKeepsVolumeAndSoundness) {
  const TriangleMesh mesh = flatten(two_cubes(), {10, 0, 0});
  EXPECT_EQ(mesh.triangles.size(), triangle_count(two_cubes()));
  EXPECT_NEAR(signed_volume(mesh), 8 + 1, 1e-5);
  EXPECT_TRUE(check_mesh(mesh).closed());
  EXPECT_NEAR(bounds(mesh).max.x, 2, 1e-6);
}

}  // namespace
}  // namespace talus
