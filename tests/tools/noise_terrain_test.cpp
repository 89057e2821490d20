#include "talus/tools/noise_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

TEST(NoiseTerrain, IsAFunctionOfPlace) {
  const NoiseTerrainParams params{.relief = 20,
                                  .feature_size = 30,
                                  .ridged = 0.5,
                                  .warp = 8,
                                  .terrace = 3,
                                  .grade = {0.1, 0.2}};
  const HeightGrid large = noise_heights(60, 50, 1, params, 3);
  const HeightGrid small = noise_heights(20, 10, 1, params, 3);
  for (int y = 0; y < small.ny; ++y)
    for (int x = 0; x < small.nx; ++x)
      EXPECT_EQ(small.heights[small.index(x, y)], large.heights[large.index(x, y)]);
}

// Cells of a third the size have their middle ones at the same places.
TEST(NoiseTerrain, CellSizeDoesNotChangeTheLandscape) {
  const NoiseTerrainParams params{.relief = 20, .feature_size = 30, .warp = 8, .terrace = 3};
  const HeightGrid coarse = noise_heights(20, 20, 1.5, params, 3);
  const HeightGrid fine = noise_heights(60, 60, 0.5, params, 3);
  for (int y = 0; y < coarse.ny; ++y)
    for (int x = 0; x < coarse.nx; ++x)
      EXPECT_NEAR(coarse.heights[coarse.index(x, y)],
                  fine.heights[fine.index(3 * x + 1, 3 * y + 1)], 1e-3);
}

TEST(NoiseTerrain, StaysWithinItsRelief) {
  for (const double ridged : {0.0, 1.0}) {
    const HeightGrid grid =
        noise_heights(200, 200, 1, {.height = 100, .relief = 10, .ridged = ridged}, 5);
    const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
    EXPECT_GE(*low, 90);
    EXPECT_LE(*high, 110);
    EXPECT_GT(*high - *low, 8);
  }
}

TEST(NoiseTerrain, GradeTiltsThePlaneAboutTheCorner) {
  const HeightGrid grid =
      noise_heights(11, 21, 2, {.height = 7, .relief = 0, .grade = {0.5, -0.25}}, 1);
  EXPECT_NEAR(grid.heights[grid.index(0, 0)], 7 + 0.5 - 0.25, 1e-5);
  EXPECT_NEAR(grid.heights[grid.index(6, 0)], 7 + 6.5 - 0.25, 1e-5);
  EXPECT_NEAR(grid.heights[grid.index(0, 12)], 7 + 0.5 - 6.25, 1e-5);
}

TEST(NoiseTerrain, SharpTerracesAreMostlyLevel) {
  const NoiseTerrainParams params{
      .relief = 20, .feature_size = 40, .terrace = 4, .terrace_sharpness = 0.8};
  const HeightGrid grid = noise_heights(150, 150, 1, params, 9);
  const auto level = std::count_if(grid.heights.begin(), grid.heights.end(), [](float h) {
    return std::abs(h - 4 * std::round(h / 4)) < 1e-3;
  });
  EXPECT_GT(static_cast<double>(level) / static_cast<double>(grid.heights.size()), 0.6);
}

TEST(NoiseTerrain, RefusesParamsOutOfRange) {
  EXPECT_THROW(noise_heights(2, 2, 1, {.octaves = 0}, 1), Error);
  EXPECT_THROW(noise_heights(2, 2, 1, {.relief = std::nan("")}, 1), Error);
}

}  // namespace
}  // namespace talus
