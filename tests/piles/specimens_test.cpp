#include "talus/piles/specimens.h"

#include <gtest/gtest.h>

#include <set>

namespace talus {
namespace {

Box3 bounds_of(const InstanceTable& table, const Instance& instance) {
  Box3 box;
  for (const Vec3f& p : table.prototypes[instance.prototype]->positions)
    box.include(world_from_local(instance, p));
  return box;
}

TEST(Specimens, LieApartOnThePlane) {
  const TileSet tiles = TileSet::make({.voxels_per_edge = 20, .axis_z = {0.4, 0.6}}, 1);
  const InstanceTable table = specimens(tiles, 30);
  ASSERT_EQ(table.instances.size(), 30u);
  EXPECT_EQ(std::set(table.prototypes.begin(), table.prototypes.end()).size(), 30u);
  std::vector<Box3> boxes;
  for (const Instance& instance : table.instances) {
    const Box3 box = bounds_of(table, instance);
    EXPECT_NEAR(box.min.z, 0, 1e-6);
    EXPECT_GE(box.size().x, box.size().z * 0.99) << "each lies down";
    for (const Box3& other : boxes)
      EXPECT_TRUE(box.max.x < other.min.x || other.max.x < box.min.x || box.max.y < other.min.y ||
                  other.max.y < box.min.y);
    boxes.push_back(box);
  }
}

TEST(Specimens, AreSortedFromLargeToSmall) {
  const TileSet tiles = TileSet::make({.voxels_per_edge = 20, .size_ratio = 3}, 1);
  const InstanceTable table = specimens(tiles, 12);
  for (std::size_t i = 1; i < table.prototypes.size(); ++i)
    EXPECT_GE(signed_volume(*table.prototypes[i - 1]), signed_volume(*table.prototypes[i]));
}

TEST(Specimens, OfASetWithFewerShapesAreAllOfThem) {
  const TileSet tiles = TileSet::make({.variety = Variety::periodic, .voxels_per_edge = 20}, 1);
  EXPECT_EQ(specimens(tiles, 1000).instances.size(), tiles.stats().distinct_meshes);
}

}  // namespace
}  // namespace talus
