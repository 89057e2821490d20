// Supports' answers for blocks of points against those for one point.
#pragma once

#include <gtest/gtest.h>

#include "talus/base/angle.h"
#include "talus/base/hash.h"
#include "talus/field/support.h"

namespace talus::test {

// From tiny ones to such as hold the box; every other one is turned.
inline PointBlock random_block(const Box3& box, int i) {
  const auto draw = [&](int which, double low, double high) {
    return uniform(hash(29, Purpose::texture, i, which), low, high);
  };
  const double size = box.longest_side() * std::ldexp(1, -static_cast<int>(draw(0, 0, 12)));
  const glm::dmat3 turn =
      i % 2 ? rotation_deg({draw(1, -180, 180), draw(2, -90, 90), draw(3, -180, 180)})
            : glm::dmat3(1);
  PointBlock block;
  for (int axis = 0; axis < 3; ++axis) {
    block.first[axis] = draw(4 + axis, box.min[axis] - size / 2, box.max[axis] - size / 2);
    block.step[static_cast<std::size_t>(axis)] = draw(7 + axis, 0.2, 0.3) * size * turn[axis];
  }
  return block;
}

// Points answer to the bit as alone; boxes around them are told of only if all in them are alike.
inline void expect_answers_as_for_one(const Support& support, const PointBlock& block, int i) {
  ASSERT_EQ(support.contains_block(block), support.Support::contains_block(block)) << "block " << i;
  const Vec3 half =
      0.5 * (glm::abs(block.step[0]) + glm::abs(block.step[1]) + glm::abs(block.step[2]));
  const BlockStates states = support.classify_block(block, half);
  ASSERT_EQ(states.inside & states.outside, 0u);
  for (int k = 0; k < kBlockPoints; ++k) {
    const bool inside = states.inside >> k & 1, outside = states.outside >> k & 1;
    if (!inside && !outside) continue;
    for (int corner = 0; corner < 27; ++corner) {
      const Vec3 to(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
      ASSERT_EQ(support.contains(block.point(k) + to * half), inside) << "block " << i;
    }
  }
}

}  // namespace talus::test
