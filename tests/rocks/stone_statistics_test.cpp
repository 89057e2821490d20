#include "talus/rocks/stone_statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace talus {
namespace {

StoneStatistics statistics_of(const TileParams& params, TileStats* stats = nullptr) {
  const auto tiles = std::make_shared<const TileSet>(TileSet::make(params, 3));
  if (stats) *stats = tiles->stats();
  return stone_statistics(std::array{tiles});
}

TileParams with_axes(double x, double y, double z) {
  TileParams params{.voxels_per_edge = 30, .axis_x = {x, x}, .axis_y = {y, y}, .axis_z = {z, z}};
  params.weathering.depth = 0.05;
  return params;
}

TEST(StoneStatistics, AgreeWithWhatTheTilesSay) {
  TileStats stats;
  const StoneStatistics s = statistics_of(with_axes(1, 1, 1), &stats);
  ASSERT_EQ(stats.empty, 0u);
  EXPECT_NEAR(s.volume.mean, 1 - stats.void_fraction, 1e-6) << "one stone a cell";

  double contacts = 0;
  for (std::size_t i = 0; i < s.contacts.size(); ++i)
    contacts += static_cast<double>(i) * s.contacts[i];
  EXPECT_NEAR(contacts, stats.contacts_mean, 1e-9);
  EXPECT_NEAR(std::accumulate(s.contacts.begin(), s.contacts.end(), 0.0), 1, 1e-9);
  for (std::size_t i = 0; i < stats.contacts_min; ++i) EXPECT_EQ(s.contacts[i], 0) << i;
  EXPECT_GT(s.contacts[stats.contacts_min], 0);
  EXPECT_NEAR(s.equant + s.discs + s.rods + s.blades, 1, 1e-9);
}

TEST(StoneStatistics, TellSlabsFromNeedles) {
  const StoneStatistics even = statistics_of(with_axes(1, 1, 1));
  const StoneStatistics slabs = statistics_of(with_axes(1, 1, 0.3));
  const StoneStatistics needles = statistics_of(with_axes(1, 1, 3));
  EXPECT_GT(even.equant, 0.5);
  EXPECT_GT(slabs.discs + slabs.blades, 0.8);
  EXPECT_GT(needles.rods + needles.blades, 0.8);
  EXPECT_GT(needles.rods, slabs.rods);
  EXPECT_GT(slabs.discs, needles.discs);
  EXPECT_GT(even.sphericity.mean, slabs.sphericity.mean);
}

TEST(StoneStatistics, StayWithinWhatShapesAllow) {
  const StoneStatistics s = statistics_of(with_axes(1, 2, 0.5));
  for (const Spread& ratio : {s.flatness, s.elongation, s.sphericity}) {
    EXPECT_GT(ratio.min, 0);
    EXPECT_LE(ratio.max, 1);
    EXPECT_LT(ratio.min, ratio.mean);
    EXPECT_LT(ratio.mean, ratio.max);
  }
}

TEST(StoneStatistics, OfNothingAreZero) {
  EXPECT_EQ(stone_statistics({}).volume.max, 0);
  EXPECT_TRUE(stone_statistics({}).contacts.empty());
}

}  // namespace
}  // namespace talus
