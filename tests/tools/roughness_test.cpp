#include "talus/tools/roughness.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "talus/base/hash.h"

namespace talus {
namespace {

// What is near a place stays around it the same way: nothing is turned inside out.
TEST(Roughness, CarriesNoTwoPlacesTogetherAndNoneTooFar) {
  for (const double most : {0.5, 2.0, 4.0}) {
    const double size = 2;
    const Roughness roughness(most, size, 3);
    for (int i = 0; i < 20'000; ++i) {
      const auto draw = [&](int k) { return uniform(hash(7, Purpose::texture, i, k), -40, 40); };
      const Vec3 p(draw(0), draw(1), draw(2)), carried = roughness.carried(p);
      ASSERT_LE(glm::length(carried - p), most * (1 + 1e-12));
      glm::dmat3 neighbors;
      constexpr double kNear = 1e-7;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 beside = p;
        beside[axis] += kNear;
        neighbors[axis] = (roughness.carried(beside) - carried) / kNear;
      }
      ASSERT_GT(glm::determinant(neighbors), 0) << most;
    }
  }
}

}  // namespace
}  // namespace talus
