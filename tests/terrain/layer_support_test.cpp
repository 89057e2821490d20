#include "talus/terrain/layer_support.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/blocks.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::pick;
using test::random_stacks;

constexpr MaterialSet kSome = {Material::rocks, Material::ice, Material::air};

LayeredTerrain sample(std::uint64_t seed) {
  return random_stacks(seed,
                       {.nx = 1 + pick(seed, 0, 50),
                        .ny = 1 + pick(seed, 1, 40),
                        .cell = 0.5,
                        .step = 0.1,
                        .origin_x = -4,
                        .origin_y = 100,
                        .floor = -12},
                       6, 40);
}

// Kinds of points in a closed box: those of every step of every column that it meets.
BoxState brute_force(const LayeredTerrain& terrain, const MaterialSet& materials, const Box3& box) {
  const TerrainGrid& grid = terrain.grid();
  bool inside = false, outside = false;
  for (int y = grid.column_y(box.min.y); y <= grid.column_y(box.max.y); ++y)
    for (int x = grid.column_x(box.min.x); x <= grid.column_x(box.max.x); ++x)
      for (Steps z = grid.step_at(box.min.z); z <= grid.step_at(box.max.z); ++z) {
        const bool in_grid = x >= 0 && x < grid.nx && y >= 0 && y < grid.ny;
        const bool in_layer = in_grid && z >= grid.floor && !terrain.column(x, y).empty() &&
                              z < terrain.column(x, y).back().top();
        (in_layer && materials.contains(terrain.material(x, y, z)) ? inside : outside) = true;
      }
  return inside ? (outside ? BoxState::mixed : BoxState::inside) : BoxState::outside;
}

Vec3 random_point(const Box3& box, std::uint64_t seed, int i) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = uniform(hash(seed, Purpose::texture, i, axis), box.min[axis], box.max[axis]);
  return p;
}

RC_GTEST_PROP(LayerSupport, BlocksAnswerAsPointsAndBoxesDo, (std::uint64_t seed)) {
  const LayeredTerrain terrain = sample(seed);
  RC_PRE(terrain.volume()[static_cast<std::size_t>(Material::rocks)] > 0);
  const LayerSupport support(terrain, kSome);
  for (int i = 0; i < 10; ++i) {
    const PointBlock block = test::random_block(support.bounds(), i);
    RC_ASSERT(support.contains_block(block) == support.Support::contains_block(block));
    const Vec3 half(0.3, 0.4, 0.2);
    const BlockStates states = support.classify_block(block, half),
                      one_by_one = support.Support::classify_block(block, half);
    RC_ASSERT(states.inside == one_by_one.inside);
    RC_ASSERT(states.outside == one_by_one.outside);
  }
}

RC_GTEST_PROP(LayerSupport, AnswersForBoxesAndPointsExactly, (std::uint64_t seed)) {
  const LayeredTerrain terrain = sample(seed);
  RC_PRE(terrain.volume()[static_cast<std::size_t>(Material::rocks)] > 0);
  const LayerSupport support(terrain, kSome);
  const Box3 around = support.bounds().expanded(1.2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_point(around, seed, 2 * i);
    RC_ASSERT((support.contains(p) ? BoxState::inside : BoxState::outside) ==
              brute_force(terrain, kSome, {p, p}));
    const Vec3 size = uniform(hash(seed, Purpose::texture, i)) * Vec3(2, 2, 0.5);
    const Box3 box{p - size, p + size};
    RC_ASSERT(support.classify(box) == brute_force(terrain, kSome, box));
  }
  RC_ASSERT(support.classify(support.bounds().expanded(1e9)) == BoxState::mixed);
}

RC_GTEST_PROP(LayerSupport, BoundsAreTight, (std::uint64_t seed)) {
  const LayeredTerrain terrain = sample(seed);
  RC_PRE(terrain.volume()[static_cast<std::size_t>(Material::rocks)] > 0);
  const LayerSupport support(terrain, {Material::rocks});
  const Box3 bounds = support.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    // Within a column's width, or a step, of either side.
    const double margin = 0.5 * (axis == 2 ? terrain.grid().step : terrain.grid().cell);
    Box3 low = bounds, high = bounds, below = bounds, above = bounds;
    low.max[axis] = bounds.min[axis] + margin;
    high.min[axis] = bounds.max[axis] - margin;
    below.max[axis] = bounds.min[axis] - 1e-6;
    below.min[axis] = -1e6;
    above.min[axis] = bounds.max[axis] + 1e-6;
    above.max[axis] = 1e6;
    RC_ASSERT(support.classify(low) != BoxState::outside);
    RC_ASSERT(support.classify(high) != BoxState::outside);
    RC_ASSERT(support.classify(below) == BoxState::outside);
    RC_ASSERT(support.classify(above) == BoxState::outside);
  }
}

TEST(LayerSupport, LeavesOutOpenAirAndWhatLiesUnderTheFloor) {
  LayeredTerrain terrain({.nx = 2, .ny = 2, .step = 1});
  terrain.edit([](int, int, ColumnEditor& c) {
    c.replace(0, 2, Material::bedrock);
    c.replace(3, 4, Material::bedrock);
  });
  const LayerSupport support(terrain, {Material::bedrock, Material::air});
  EXPECT_TRUE(support.contains({1, 1, 0.5}));
  EXPECT_TRUE(support.contains({1, 1, 2.5}));
  EXPECT_FALSE(support.contains({1, 1, -0.5}));
  EXPECT_FALSE(support.contains({1, 1, 4.5}));
  EXPECT_EQ(support.bounds().min, Vec3(0));
  EXPECT_EQ(support.bounds().max, Vec3(2, 2, 4));
}

TEST(LayerSupport, RefusesATerrainWithoutSuchLayers) {
  const LayeredTerrain empty({.nx = 10, .ny = 10});
  EXPECT_THROW(LayerSupport(empty, {Material::bedrock, Material::rocks}), Error);
  EXPECT_THROW(LayerSupport(random_stacks(1, {.nx = 10, .ny = 10}), {}), Error);
}

}  // namespace
}  // namespace talus
