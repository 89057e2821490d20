#include "talus/piles/pile_edits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "piles/small_tiles.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

const ShapeSupport kBall(Sphere{.radius = 2});
const PileParams kParams{.stone_size = {0.4}};

Pile ball() { return fill(kBall, test::small_tiles(4), kParams); }

// The stones as ids.
std::vector<StoneId> ids_of(const Pile& pile) {
  std::vector<StoneId> ids;
  for (const PlacedStone& s : placed_stones(pile))
    ids.push_back({s.cell, pile.tiles->stones()[s.stone].seed});
  return ids;
}

bool has(const std::vector<StoneId>& ids, const StoneId& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

TEST(PileEdits, RemovingAStoneChangesNothingElse) {
  const Pile whole = ball();
  const std::vector<StoneId> ids = ids_of(whole);
  for (std::size_t k = 0; k < ids.size(); k += 37) {
    Pile pile = whole;
    remove_stone(pile, ids[k]);
    std::vector<StoneId> left = ids;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    ASSERT_EQ(ids_of(pile), left);
    ASSERT_EQ(pile.stats.instances, left.size());
    place_stone(pile, ids[k]);
    ASSERT_EQ(pile.stones, whole.stones);
  }
}

TEST(PileEdits, FilledAnewTheyAreThereAgain) {
  const std::vector<StoneId> ids = ids_of(ball());
  const StoneId outside{.cell = {40, 40, 40}, .seed = 0};
  const PileControl control{.removed = {ids[5], ids[50]},
                            .locked = {outside},
                            .moved = {{.stone = ids[70], .by = {0, 0, 3}}}};
  // Another support, other stones, the same edits.
  for (const double radius : {2.0, 2.3}) {
    const ShapeSupport support(Sphere{.radius = radius});
    PileParams params = kParams;
    params.tiling.at = Vec3(-2);
    const Pile without = fill(support, test::small_tiles(4), params);
    const Pile pile = fill(support, test::small_tiles(4), params, control);
    const std::vector<StoneId> now = ids_of(pile);
    EXPECT_FALSE(has(now, ids[5]) || has(now, ids[50]) || has(now, ids[70]));
    EXPECT_TRUE(has(now, outside));
    ASSERT_EQ(pile.moved.size(), 1u);
    EXPECT_EQ(now.size(), without.stats.instances - 2);
    EXPECT_EQ(pile.stats.instances, without.stats.instances - 1);
    EXPECT_EQ(instances(pile).instances.size(), pile.stats.instances);
  }
}

TEST(PileEdits, AllStonesMayBeRemoved) {
  const ShapeSupport small(Sphere{.radius = 0.5});
  PileParams params{.stone_size = {0.9}};
  const Pile pile = fill(small, test::small_tiles(4), params);
  const PileControl control{.removed = ids_of(pile)};
  EXPECT_EQ(fill(small, test::small_tiles(4), params, control).stats.instances, 0u);
}

TEST(PileEdits, AMovedStoneLiesWhereItWasPut) {
  Pile pile = ball();
  const StoneId id = ids_of(pile)[33];
  const auto position_of = [&](const Pile& of) {
    std::vector<Vec3> places;
    for (const Instance& i : instances(of).instances) places.push_back(i.position);
    return places;
  };
  const std::vector<Vec3> before = position_of(pile);
  move_stone(pile, {.stone = id, .by = {10, 0, 0}, .rotate_deg = {0, 0, 90}});
  move_stone(pile, {.stone = id, .by = {20, 0, 0}, .rotate_deg = {0, 0, 90}});
  EXPECT_EQ(pile.stats.instances, before.size());
  ASSERT_EQ(pile.moved.size(), 1u) << "a stone is moved from its place, not from where it was put";
  const InstanceTable table = instances(pile);
  const auto moved = std::find_if(table.instances.begin(), table.instances.end(),
                                  [](const Instance& i) { return i.position.x > 10; });
  ASSERT_NE(moved, table.instances.end());
  const Vec3 from = moved->position - Vec3(20, 0, 0);
  EXPECT_TRUE(std::any_of(before.begin(), before.end(),
                          [&](const Vec3& p) { return glm::distance(p, from) < 1e-9; }));
  EXPECT_LT(glm::distance(moved->rotation * Vec3f(1, 0, 0), Vec3f(0, 1, 0)), 1e-6f);
  place_stone(pile, id);
  EXPECT_EQ(position_of(pile), before);
}

TEST(PileEdits, APartFilledAnewReplacesWhatWasThere) {
  const PileFiller filler(kBall, test::small_tiles(4), kParams);
  const Pile whole = filler.fill(filler.cubes());
  for (const CubeBox& part : split(filler.cubes(), 12)) {
    Pile pile = whole;
    Pile emptied = filler.fill(part);
    emptied.stones = CubeBits(emptied.stones.words_per_cube());
    replace_part(pile, part, emptied);
    EXPECT_EQ(pile.stats.instances, whole.stats.instances - filler.fill(part).stats.instances);
    replace_part(pile, part, filler.fill(part));
    ASSERT_EQ(pile.stones, whole.stones);
    ASSERT_EQ(pile.stats.instances, whole.stats.instances);
  }
}

TEST(PileEdits, StonesThatDoNotExistAreNamed) {
  Pile pile = ball();
  for (const int seed : {-1, 99}) {
    try {
      remove_stone(pile, {.cell = {1, 2, 3}, .seed = seed});
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find("cell (1, 2, 3) has no stone"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace talus
