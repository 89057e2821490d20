#include "talus/io/fill_holes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"

namespace talus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

HeightGrid grid_of(int nx, int ny, const std::function<double(int x, int y)>& height) {
  HeightGrid grid{.nx = nx, .ny = ny};
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) grid.heights.push_back(static_cast<float>(height(x, y)));
  return grid;
}

TEST(FillHoles, ContinuesAPlane) {
  // A membrane in a flat frame is flat, however wide the hole.
  const auto plane = [](int x, int y) { return 1000 + 2.0 * x - 0.7 * y; };
  for (const int hole : {1, 3, 20, 150}) {
    const int n = 3 * hole;
    const HeightGrid whole = grid_of(n, n, plane);
    HeightGrid grid = whole;
    for (int y = hole; y < 2 * hole; ++y)
      for (int x = hole; x < 2 * hole; ++x) grid.heights[grid.index(x, y)] = kUnknown;
    fill_holes(grid);
    for (std::size_t i = 0; i < grid.heights.size(); ++i)
      ASSERT_NEAR(grid.heights[i], whole.heights[i], 0.05) << hole << " " << i;
  }
}

// Hills with holes of many sizes and an unknown rim.
HeightGrid torn_hills() {
  return grid_of(217, 150, [](int x, int y) {
    const bool rim = x < 9 || x + 2 * y < 60;
    const bool hole = uniform(hash(1, Purpose::texture, x / 7, y / 5)) < 0.3;
    return rim || hole ? kUnknown : 50 * std::sin(0.1 * x) + 30 * std::cos(0.13 * y) + x;
  });
}

TEST(FillHoles, KeepsKnownHeightsAndFillsWithTheMeanOfNeighbors) {
  const HeightGrid torn = torn_hills();
  HeightGrid grid = torn;
  fill_holes(grid);
  const auto at = [&](int x, int y) { return grid.heights[grid.index(x, y)]; };
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x) {
      const float before = torn.heights[torn.index(x, y)];
      if (!std::isnan(before)) {
        ASSERT_EQ(at(x, y), before);
        continue;
      }
      float sum = 0;
      int count = 0;
      const auto add = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= grid.nx || v >= grid.ny) return;
        sum += at(u, v);
        ++count;
      };
      add(x - 1, y);
      add(x + 1, y);
      add(x, y - 1);
      add(x, y + 1);
      ASSERT_NEAR(at(x, y), sum / static_cast<float>(count), 0.01) << x << ", " << y;
    }
}

TEST(FillHoles, OneKnownHeightFillsAll) {
  HeightGrid grid =
      grid_of(13, 70, [](int x, int y) { return x == 4 && y == 66 ? 12.5 : kUnknown; });
  fill_holes(grid);
  for (const float z : grid.heights) EXPECT_NEAR(z, 12.5, 1e-3);
}

TEST(FillHoles, LeavesAGridWithoutHeightsOrHolesAlone) {
  HeightGrid none = grid_of(5, 5, [](int, int) { return kUnknown; });
  fill_holes(none);
  for (const float z : none.heights) EXPECT_TRUE(std::isnan(z));
  HeightGrid all = grid_of(5, 5, [](int x, int y) { return x * y; });
  const std::vector<float> before = all.heights;
  fill_holes(all);
  EXPECT_EQ(all.heights, before);
}

TEST(FillHoles, SameHeightsForAnyThreads) {
  HeightGrid one = torn_hills(), many = torn_hills();
  fill_holes(many);
  const ThreadLimit limit(1);
  fill_holes(one);
  EXPECT_EQ(one.heights, many.heights);
}

}  // namespace
}  // namespace talus
