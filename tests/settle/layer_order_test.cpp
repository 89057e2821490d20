#include "talus/settle/layer_order.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "talus/base/parallel.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::pick;
using test::random_stacks;
using test::sum;
using Layers = std::vector<std::pair<Material, Steps>>;

// One column of layers given bottom up by material and thickness, sorted.
Layers sorted(const Layers& layers, Booking* booking = nullptr) {
  LayeredTerrain terrain({});
  terrain.edit([&](int, int, ColumnEditor& column) {
    Steps z = 0;
    for (const auto& [material, thickness] : layers) {
      column.replace(z, z + thickness, material);
      z += thickness;
    }
  });
  const Booking booked = sort_layers(terrain);
  if (booking) *booking = booked;
  Layers result;
  Steps z = 0;
  for (const Layer& layer : terrain.column(0, 0)) {
    result.emplace_back(layer.material(), layer.top() - z);
    z = layer.top();
  }
  return result;
}

using enum Material;

TEST(LayerOrder, SortsAndMergesDepositsAboveBedrock) {
  Booking booking;
  EXPECT_EQ(
      sorted({{bedrock, 5}, {ice, 1}, {sand, 2}, {water, 3}, {soil, 4}, {sand, 1}, {rocks, 2}},
             &booking),
      (Layers{{bedrock, 5}, {sand, 3}, {soil, 4}, {rocks, 2}, {water, 3}, {ice, 1}}));
  EXPECT_EQ(booking, Booking());
}

TEST(LayerOrder, DepositsInACaveFallToItsGround) {
  EXPECT_EQ(
      sorted({{bedrock, 5}, {air, 4}, {sand, 2}, {air, 1}, {bedrock, 3}, {air, 2}, {snow, 1}}),
      (Layers{{bedrock, 5}, {sand, 2}, {air, 5}, {bedrock, 3}, {snow, 1}}));
}

TEST(LayerOrder, DepositsLieOnTheFloorWhereThereIsNoBedrock) {
  EXPECT_EQ(sorted({{air, 4}, {soil, 2}, {sand, 1}}), (Layers{{sand, 1}, {soil, 2}}));
}

TEST(LayerOrder, SnowOnOpenWaterBecomesWaterOfItsMass) {
  Booking booking;
  EXPECT_EQ(sorted({{bedrock, 5}, {water, 10}, {snow, 100}}, &booking),
            (Layers{{bedrock, 5}, {water, 40}}));
  const Conversion melted = booking.conversion(snow, water);
  EXPECT_EQ(melted.from_steps, 100);
  EXPECT_EQ(melted.to_steps, 30);
}

TEST(LayerOrder, IceKeepsSnowFromTheWater) {
  const Layers lake = {{bedrock, 5}, {water, 10}, {ice, 1}, {snow, 100}};
  EXPECT_EQ(sorted(lake), lake);
}

TEST(LayerOrder, SnowThatMeltsInACaveLeavesAir) {
  EXPECT_EQ(sorted({{bedrock, 5}, {water, 10}, {snow, 10}, {bedrock, 1}}),
            (Layers{{bedrock, 5}, {water, 13}, {air, 7}, {bedrock, 1}}));
}

RC_GTEST_PROP(LayerOrder, ConservesEveryStepAndEveryTileItsMass, (std::uint64_t seed)) {
  LayeredTerrain terrain =
      random_stacks(seed, {.nx = 1 + pick(seed, 0, 80), .ny = 1 + pick(seed, 1, 70), .floor = -7});
  const MaterialSteps before = terrain.volume();
  const Booking booking = sort_layers(terrain);
  RC_ASSERT(sum(before, booking.change()) == terrain.volume());
  for (int from = 0; from < kMaterialCount; ++from)
    for (int to = 0; to < kMaterialCount; ++to)
      RC_ASSERT((static_cast<Material>(from) == snow && static_cast<Material>(to) == water) ||
                booking.replaced(static_cast<Material>(from), static_cast<Material>(to)) == 0);
  const Conversion melted = booking.conversion(snow, water);
  const double tiles = (terrain.grid().nx > 64 ? 2 : 1) * (terrain.grid().ny > 64 ? 2 : 1);
  const double lost = static_cast<double>(melted.from_steps) * material_info(snow).density -
                      static_cast<double>(melted.to_steps) * material_info(water).density;
  RC_ASSERT(lost >= 0);
  RC_ASSERT(lost < tiles * material_info(water).density);
}

RC_GTEST_PROP(LayerOrder, LeavesBedrockWhereItIsAndDepositsInOrder, (std::uint64_t seed)) {
  const LayeredTerrain before = random_stacks(seed, {.nx = 30, .ny = 5, .floor = 3});
  LayeredTerrain terrain = before;
  sort_layers(terrain);
  test::expect_well_formed(terrain);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 30; ++x) {
      for (Steps z = 0; z < 100; ++z)
        RC_ASSERT((terrain.material(x, y, z) == bedrock) == (before.material(x, y, z) == bedrock));
      const auto layers = terrain.column(x, y);
      for (std::size_t i = 1; i < layers.size(); ++i) {
        const Material lower = layers[i - 1].material(), upper = layers[i].material();
        RC_ASSERT(upper == bedrock || lower < upper);
        RC_ASSERT(!(lower == water && upper == snow));
      }
    }
}

RC_GTEST_PROP(LayerOrder, SortingTwiceChangesNothingMore, (std::uint64_t seed)) {
  LayeredTerrain once = random_stacks(seed, {.nx = 30, .ny = 5});
  sort_layers(once);
  LayeredTerrain twice = once;
  RC_ASSERT(sort_layers(twice) == Booking());
  RC_ASSERT(twice == once);
  RC_ASSERT(once.column(0, 0).data() == twice.column(0, 0).data());
}

TEST(LayerOrder, IsTheSameForAnyNumberOfThreads) {
  const auto made_by = [](int threads) {
    const ThreadLimit limit(threads);
    LayeredTerrain terrain = random_stacks(8, {.nx = 200, .ny = 150});
    const Booking booking = sort_layers(terrain);
    return std::pair(terrain, booking);
  };
  EXPECT_EQ(made_by(1), made_by(2));
}

TEST(LayerOrder, SortsOnlyTheAreaAsked) {
  LayeredTerrain before = random_stacks(9, {.nx = 20, .ny = 20});
  // How much water snow becomes is rounded with regard to the columns before: no snow.
  before.edit([](int, int, ColumnEditor& column) {
    const std::vector<Layer> layers(column.layers().begin(), column.layers().end());
    Steps bottom = column.floor();
    for (const Layer& layer : layers) {
      if (layer.material() == snow) column.replace(bottom, layer.top(), ice);
      bottom = layer.top();
    }
  });
  const ColumnArea area{3, 4, 10, 20};
  LayeredTerrain part = before, whole = before;
  sort_layers(part, area);
  sort_layers(whole);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const auto now = part.column(x, y);
      const auto expected = (area.contains(x, y) ? whole : before).column(x, y);
      ASSERT_TRUE(std::ranges::equal(now, expected)) << x << ", " << y;
    }
}

}  // namespace
}  // namespace talus
