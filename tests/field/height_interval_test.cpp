#include "talus/field/height_interval.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "field/blocks.h"
#include "talus/base/error.h"

namespace talus {
namespace {

struct Surfaces {
  HeightGrid lower, upper;
};

// Some of the heights are unknown, some of the upper ones below.
Surfaces random_surfaces(std::uint64_t seed) {
  const auto draw = [&](int what, int i) { return hash(seed, Purpose::texture, what, i); };
  Surfaces s;
  s.lower.nx = 2 + static_cast<int>(draw(0, 0) % 20);
  s.lower.ny = 2 + static_cast<int>(draw(0, 1) % 20);
  s.lower.cell = uniform(draw(0, 2), 0.2, 2);
  s.upper = s.lower;
  for (int i = 0; i < s.lower.nx * s.lower.ny; ++i) {
    const double low = uniform(draw(1, i), 5, 8), high = low + uniform(draw(2, i), -0.5, 4);
    const bool is_known = draw(3, i) % 10 != 0;
    s.lower.heights.push_back(static_cast<float>(low));
    s.upper.heights.push_back(is_known ? static_cast<float>(high)
                                       : std::numeric_limits<float>::quiet_NaN());
  }
  s.upper.heights[0] = s.lower.heights[0] + 1;
  return s;
}

// Weighed sum of the four samples around, written down anew.
double bilinear(const HeightGrid& grid, double x, double y) {
  const double u = std::clamp(x / grid.cell - 0.5, 0.0, grid.nx - 1.0),
               v = std::clamp(y / grid.cell - 0.5, 0.0, grid.ny - 1.0);
  double sum = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double weight = std::max(0.0, 1 - std::abs(u - i)) * std::max(0.0, 1 - std::abs(v - j));
      if (weight > 0) sum += weight * double{grid.heights[grid.index(i, j)]};
    }
  return sum;
}

RC_GTEST_PROP(HeightInterval, HoldsWhatLiesBetween, (std::uint64_t seed)) {
  const auto [lower, upper] = random_surfaces(seed);
  const Vec2 corner(100, -7);
  const HeightIntervalSupport support(lower, upper, corner);
  const Box3 around = support.bounds().expanded(0.3);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] =
          uniform(hash(seed, Purpose::seed_position, i, axis), around.min[axis], around.max[axis]);
    const double low = bilinear(lower, p.x - corner.x, p.y - corner.y),
                 high = bilinear(upper, p.x - corner.x, p.y - corner.y);
    if (std::abs(p.z - low) < 1e-9 || std::abs(p.z - high) < 1e-9) continue;
    const Box3 plan{Vec3(corner, -1e9), Vec3(corner + upper.cell * Vec2(upper.nx, upper.ny), 1e9)};
    RC_ASSERT(support.contains(p) == (plan.contains(p) && low < p.z && p.z < high));
    inside += support.contains(p);
    if (support.contains(p)) RC_ASSERT(support.bounds().expanded(1e-9).contains(p));
  }
  RC_TAG(inside > 0 ? "some inside" : "none inside");
}

TEST(HeightInterval, BlocksAnswerAsPointsAndBoxesDo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto [lower, upper] = random_surfaces(seed);
    const HeightIntervalSupport support(lower, upper);
    for (int i = 0; i < 100; ++i)
      test::expect_answers_as_for_one(support, test::random_block(support.bounds(), i), i);
  }
}

TEST(HeightInterval, ClassifiedBoxesAnswerAlikeEverywhere) {
  int inside = 0, outside = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto [lower, upper] = random_surfaces(seed);
    const HeightIntervalSupport support(lower, upper);
    for (int i = 0; i < 1000; ++i) {
      const PointBlock block = test::random_block(support.bounds(), i);
      const Box3 box = block.box_around(Vec3(0));
      const BoxState state = support.classify(box);
      inside += state == BoxState::inside;
      outside += state == BoxState::outside;
      if (state == BoxState::mixed) continue;
      for (int k = 0; k < kBlockPoints; ++k)
        ASSERT_EQ(support.contains(block.point(k)), state == BoxState::inside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

std::string refusal(const HeightGrid& lower, const HeightGrid& upper) {
  try {
    HeightIntervalSupport(lower, upper);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "made";
}

TEST(HeightInterval, RefusesOtherCellsAndNoRoom) {
  const HeightGrid flat{.nx = 2, .ny = 1, .heights = {1, 1}};
  HeightGrid wide = flat, above = flat;
  wide.cell = 2;
  above.heights = {1, 2};
  EXPECT_EQ(refusal(flat, wide),
            "the lower surface has 2 x 1 cells of 1 m and the upper one 2 x 1 of 2 m; give two of "
            "the same cells");
  EXPECT_EQ(refusal(above, flat),
            "the upper surface is nowhere above the lower one, so that nothing is left");
  EXPECT_EQ(refusal(flat, above), "made");
}

}  // namespace
}  // namespace talus
