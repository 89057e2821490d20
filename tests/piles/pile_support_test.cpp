#include "talus/piles/pile_support.h"

#include <gtest/gtest.h>

#include "piles/small_tiles.h"
#include "talus/base/hash.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

Vec3 place(int i, double reach) {
  const auto draw = [&](int what) {
    return uniform(hash(9, Purpose::seed_position, i, what), -reach, reach);
  };
  return {draw(0), draw(1), draw(2)};
}

Pile boulders() {
  return fill(ShapeSupport(Sphere{.radius = 3}), test::small_tiles(),
              {.stone_size = {1.5}, .tiling = {.rotate_deg = {15, 25, 35}}, .density = 0.3});
}

TEST(PileSupport, HoldsTheStonesVoxelsAndTheirNeighbors) {
  const Pile pile = boulders();
  const PileSupport support(pile);
  const TileSet& tiles = *pile.tiles;
  const double voxel = static_cast<double>(tiles.params().n) / tiles.params().voxels();
  // Asked stone by stone.
  const auto holds = [&](const Vec3& p, int margin) {
    const Vec3 at =
        glm::transpose(pile.tiling.turn) * (p - pile.tiling.origin) / pile.tiling.cell_size;
    for (const PlacedStone& placed : placed_stones(pile)) {
      const StoneSolid& solid = tiles.stones()[placed.stone].solid;
      const Int3 v = Int3(glm::floor((at - Vec3(placed.cell)) / voxel)) - solid.min;
      for (int z = -margin; z <= margin; ++z)
        for (int y = -margin; y <= margin; ++y)
          for (int x = -margin; x <= margin; ++x) {
            const Int3 w = v + Int3(x, y, z);
            if (CubeBox{Int3(0), solid.size}.contains(w) && solid.test(w.x, w.y, w.z)) return true;
          }
    }
    return false;
  };
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = place(i, 5);
    ASSERT_EQ(support.contains(p), holds(p, 1));
    inside += support.contains(p);
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 2000);
}

TEST(PileSupport, BoxesAreCertain) {
  const PileSupport support(boulders());
  int outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = place(i, 6);
    const Box3 box{p, p + 0.6};
    if (support.classify(box) != BoxState::outside) continue;
    ++outside;
    for (int k = 0; k < 20; ++k) ASSERT_FALSE(support.contains(p + 0.3 + place(k, 0.3)));
  }
  EXPECT_GT(outside, 100);
}

TEST(PileSupport, SmallBoxesAreToldOf) {
  const PileSupport support(boulders());
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = place(i, 4);
    const Box3 box{p, p + 0.02};
    const BoxState state = support.classify(box);
    inside += state == BoxState::inside;
    outside += state == BoxState::outside;
    if (state == BoxState::mixed) continue;
    for (int k = 0; k < 8; ++k) {
      const Vec3 to(k & 1, k >> 1 & 1, k >> 2);
      ASSERT_EQ(support.contains(p + 0.02 * to), state == BoxState::inside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 1000);
}

TEST(PileSupport, GravelBetweenBouldersMeetsNone) {
  const Pile large = boulders();
  const PileSupport taken(large);
  const ShapeSupport ball(Sphere{.radius = 3});
  const Pile gravel = fill(ball, test::small_tiles(), {.stone_size = {0.4}}, {.keep_out = &taken});
  EXPECT_GT(gravel.stats.instances, 100u);
  const Pile free = fill(ball, test::small_tiles(), {.stone_size = {0.4}});
  EXPECT_LT(gravel.stats.instances, free.stats.instances);
  EXPECT_GT(gravel.stats.gap_fraction(), free.stats.gap_fraction());
  EXPECT_LT(free.stats.gap_fraction(), 0.05);
  // Not a vertex of the one lies in a voxel of the other or next to it.
  const InstanceTable table = instances(gravel);
  const double voxel = 1.0 / 4;  // of the boulders, in cells
  for (const PlacedStone& placed : placed_stones(large)) {
    const Stone& stone = large.tiles->stones()[placed.stone];
    for (const Instance& instance : table.instances) {
      const Vec3 pivot = large.tiling.world(Vec3(placed.cell) + stone.pivot);
      if (glm::distance(pivot, instance.position) > 3) continue;
      for (const Vec3f& p : table.prototypes[instance.prototype]->positions) {
        const Vec3 at = glm::transpose(large.tiling.turn) *
                        (world_from_local(instance, p) - large.tiling.origin) /
                        large.tiling.cell_size;
        const Int3 v = Int3(glm::floor((at - Vec3(placed.cell)) / voxel)) - stone.solid.min;
        const CubeBox voxels{Int3(0), stone.solid.size};
        ASSERT_FALSE(voxels.contains(v) && stone.solid.test(v.x, v.y, v.z));
      }
    }
  }
}

}  // namespace
}  // namespace talus
