#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "piles/small_tiles.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/field/shape.h"
#include "talus/piles/pile.h"

namespace talus {
namespace {

using Row = std::tuple<int, int, int, std::uint32_t>;

std::vector<Row> rows_of(const Pile& pile) {
  std::vector<Row> rows;
  for (const PlacedStone& s : placed_stones(pile))
    rows.emplace_back(s.cell.z, s.cell.y, s.cell.x, s.stone);
  std::sort(rows.begin(), rows.end());
  return rows;
}

double draw(int round, int what, double low, double high) {
  return uniform(hash(77, Purpose::seed_position, round, what), low, high);
}

// Balls, capsules and a hole, at random.
ShapeSupport random_support(int round) {
  const auto place = [&](int what) {
    return Vec3(draw(round, what, -2, 2), draw(round, what + 1, -2, 2),
                draw(round, what + 2, -2, 2));
  };
  const Combination solid{
      Combination::Rule::join,
      draw(round, 0, 0, 0.5),
      {Sphere{place(1), draw(round, 4, 0.8, 2)},
       Capsule{place(5), place(8), draw(round, 11, 0.3, 1), draw(round, 12, 0.3, 1)}}};
  return ShapeSupport(Combination{
      Combination::Rule::subtract, 0, {solid, Sphere{place(13), draw(round, 16, 0.2, 1)}}});
}

PileParams random_params(int round) {
  PileParams params{.stone_size = {draw(round, 20, 0.25, 0.5)},
                    .inside_fraction = draw(round, 21, 0.1, 1)};
  if (round % 3 == 1) params.tiling.rotate_deg = {draw(round, 22, -180, 180), 40, 250};
  if (round % 4 == 2) params.tiling.at = Vec3(draw(round, 23, -9, 9), 4, -7);
  if (round % 5 == 3) params.membership = Membership::center;
  return params;
}

// The rule, without cubes, boxes and bits: each stone asked for each anchor.
class BruteForce {
 public:
  BruteForce(const Support& support, const Support* keep_out, const TileSet& tiles,
             const PileParams& params, const Tiling& tiling)
      : support_(support), keep_out_(keep_out), tiles_(tiles), params_(params), tiling_(tiling) {
    const glm::dmat3 back = glm::transpose(tiling.turn);
    const Box3 bounds = support.bounds();
    Box3 cells;
    for (int c = 0; c < 8; ++c)
      cells.include(back *
                    (Vec3(c & 1 ? bounds.max.x : bounds.min.x, c & 2 ? bounds.max.y : bounds.min.y,
                          c & 4 ? bounds.max.z : bounds.min.z) -
                     tiling.origin) /
                    tiling.cell_size);
    first_ = Int3(glm::floor(cells.min)) - 3;
    last_ = Int3(glm::ceil(cells.max)) + 3;
  }

  std::vector<Row> rows() {
    for_each_stone([&](const Int3& cell, std::uint32_t i) {
      if (lies_inside(cell, tiles_.stones()[i])) inside_[key(cell)].push_back(i);
    });
    std::vector<Row> rows;
    for_each_stone([&](const Int3& cell, std::uint32_t i) {
      const auto& here = inside_[key(cell)];
      if (std::find(here.begin(), here.end(), i) != here.end() && touches_another(cell, i))
        rows.emplace_back(cell.z, cell.y, cell.x, i);
    });
    std::sort(rows.begin(), rows.end());
    return rows;
  }

 private:
  static std::tuple<int, int, int> key(const Int3& c) { return {c.x, c.y, c.z}; }

  void for_each_stone(auto&& visit) const {
    for (int z = first_.z; z <= last_.z; ++z)
      for (int y = first_.y; y <= last_.y; ++y)
        for (int x = first_.x; x <= last_.x; ++x) {
          const TileSet::Run run = tiles_.stones_at({x, y, z});
          for (std::uint32_t i = run.first; i < run.first + run.count; ++i)
            if (tiles_.stones()[i].mesh) visit(Int3(x, y, z), i);
        }
  }

  bool lies_inside(const Int3& cell, const Stone& stone) const {
    const Vec3 seed = tiling_.world(Vec3(cell) + stone.seed_position);
    const double voxel = static_cast<double>(tiles_.params().n) / tiles_.params().voxels();
    int anchors = 1, inside = support_.contains(seed);
    bool is_out = !keep_out_ || !keep_out_->contains(seed);
    const StoneSolid& solid = stone.solid;
    for (int z = 0; z < solid.size.z; ++z)
      for (int y = 0; y < solid.size.y; ++y)
        for (int x = 0; x < solid.size.x; ++x) {
          if (!solid.test(x, y, z)) continue;
          const Vec3 p =
              tiling_.world(Vec3(cell) + voxel * (Vec3(solid.min + Int3(x, y, z)) + 0.5));
          ++anchors;
          inside += support_.contains(p);
          is_out = is_out && (!keep_out_ || !keep_out_->contains(p));
        }
    if (params_.membership == Membership::center) return is_out && support_.contains(seed);
    return is_out && inside >= std::ceil(params_.inside_fraction * anchors);
  }

  bool touches_another(const Int3& cell, std::uint32_t i) {
    const Stone& stone = tiles_.stones()[i];
    for (const StoneContact& contact : stone.contacts) {
      if (!contact.kept) continue;
      for (const std::uint32_t j : inside_[key(cell + contact.cell)]) {
        const Stone& other = tiles_.stones()[j];
        if (other.seed != contact.seed) continue;
        for (const StoneContact& back : other.contacts)
          if (back.kept && back.cell == -contact.cell && back.seed == stone.seed) return true;
      }
    }
    return false;
  }

  const Support& support_;
  const Support* keep_out_;
  const TileSet& tiles_;
  PileParams params_;
  Tiling tiling_;
  Int3 first_, last_;
  std::map<std::tuple<int, int, int>, std::vector<std::uint32_t>> inside_;
};

TEST(Fill, ChoosesWhatAskingForEveryAnchorChooses) {
  for (int round = 0; round < 12; ++round) {
    const ShapeSupport support = random_support(round);
    const ShapeSupport hole(Sphere{{draw(round, 30, -1, 1), 0, 0}, 0.7});
    const PileControl control{.keep_out = round % 2 == 1 ? &hole : nullptr};
    const PileParams params = random_params(round);
    const auto tiles = test::small_tiles(round % 4 == 0 ? 4 : 1);
    const PileFiller filler(support, tiles, params, control);
    const Pile pile = filler.fill(filler.cubes());
    ASSERT_EQ(rows_of(pile),
              BruteForce(support, control.keep_out, *tiles, params, pile.tiling).rows())
        << round;
    ASSERT_GT(pile.stats.instances, 20u) << round;
  }
}

TEST(Fill, RegionByRegionIsTheWhole) {
  for (int round = 0; round < 12; ++round) {
    const ShapeSupport support = random_support(round);
    PileParams params = random_params(round);
    params.surface_only = round % 2 == 0;
    params.density = round % 3 == 0 ? 0.7 : 1;
    const PileFiller filler(support, test::small_tiles(round % 4 == 0 ? 4 : 1), params);
    const Pile whole = filler.fill(filler.cubes());
    for (const std::uint64_t cubes : {1, 7, 40}) {
      const std::vector<CubeBox> parts = split(filler.cubes(), cubes);
      EXPECT_GT(parts.size(), 1u);
      CubeBits joined(whole.stones.words_per_cube());
      PileStats sum;
      double volume = 0;
      for (const CubeBox& part : parts) {
        const Pile piece = filler.fill(part);
        for (std::size_t i = 0; i < piece.stones.size(); ++i) {
          ASSERT_TRUE(part.contains(piece.stones.cube(i)));
          joined.put(piece.stones.cube(i), piece.stones.words(i));
        }
        sum.instances += piece.stats.instances;
        sum.hidden += piece.stats.hidden;
        sum.isolated += piece.stats.isolated;
        sum.thinned += piece.stats.thinned;
        volume += part.volume();
      }
      EXPECT_EQ(joined, whole.stones);
      EXPECT_EQ(sum.instances, whole.stats.instances);
      EXPECT_EQ(sum.hidden, whole.stats.hidden);
      EXPECT_EQ(sum.isolated, whole.stats.isolated);
      EXPECT_EQ(sum.thinned, whole.stats.thinned);
      EXPECT_EQ(volume, filler.cubes().volume());
    }
  }
}

TEST(Fill, NoTwoStonesShareAVoxel) {
  for (int round = 0; round < 4; ++round) {
    const auto tiles = test::small_tiles(round % 2 == 0 ? 4 : 1);
    const Pile pile = fill(random_support(round), tiles, random_params(round));
    const int per_cell = tiles->params().voxels() / tiles->params().n;
    std::map<std::tuple<int, int, int>, int> owners;
    for (const PlacedStone& placed : placed_stones(pile)) {
      const StoneSolid& solid = tiles->stones()[placed.stone].solid;
      for (int z = 0; z < solid.size.z; ++z)
        for (int y = 0; y < solid.size.y; ++y)
          for (int x = 0; x < solid.size.x; ++x) {
            if (!solid.test(x, y, z)) continue;
            const Int3 v = per_cell * placed.cell + solid.min + Int3(x, y, z);
            ASSERT_EQ(++owners[std::tuple(v.x, v.y, v.z)], 1);
          }
    }
  }
}

TEST(Fill, TurningAndMovingTilingAndSupportTogetherChangesNothing) {
  // By quarter turns, which are exact.
  const ShapeSupport upright(Capsule{{0, 0, 0}, {0, 0, 4}, 1, 0.5});
  const ShapeSupport lying(Capsule{{8, 0, 0}, {12, 0, 0}, 1, 0.5});
  PileParams params{.stone_size = {0.25}, .tiling = {.at = Vec3(-1, -1, -1)}};
  const auto rows = rows_of(fill(upright, test::small_tiles(), params));
  // About y: z becomes x, x becomes -z.
  params.tiling = {.at = Vec3(7, -1, 1), .rotate_deg = {0, 90, 0}};
  EXPECT_EQ(rows_of(fill(lying, test::small_tiles(), params)), rows);
}

TEST(Fill, InstancesLieWhereTheTilingDoes) {
  PileParams params{.stone_size = {0.4}, .tiling = {.rotate_deg = {10, 20, 30}}};
  const Pile pile = fill(ShapeSupport(Sphere{{5, 6, 7}, 2}), test::small_tiles(), params);
  const InstanceTable table = instances(pile);
  ASSERT_EQ(table.instances.size(), pile.stats.instances);
  const Quat turn = table.instances[0].rotation;
  for (const Instance& instance : table.instances) {
    EXPECT_LT(glm::distance(instance.position, Vec3(5, 6, 7)), 2.5);
    EXPECT_FLOAT_EQ(instance.scale, 0.4f);
    EXPECT_EQ(instance.rotation, turn);
  }
  EXPECT_LT(glm::distance(Vec3(turn * Vec3f(1, 2, 3)), pile.tiling.turn * Vec3(1, 2, 3)), 1e-6);
}

TEST(Fill, FullCubesTakeLessThanHalfAByteForAStone) {
  const Pile pile =
      fill(ShapeSupport(Box{.size = Vec3(8)}), test::small_tiles(), {.stone_size = {0.1}});
  EXPECT_LT(static_cast<double>(pile.stones.bytes()),
            0.5 * static_cast<double>(pile.stats.instances));
}

TEST(Fill, DensityKeepsThatShareAndAMaskSaysWhere) {
  const ShapeSupport box(Box{.size = {6, 6, 1}});
  const PileParams params{.stone_size = {0.25}};
  const Pile whole = fill(box, test::small_tiles(), params);
  const auto all = rows_of(whole);
  PileParams half = params;
  half.density = 0.5;
  const Pile thin = fill(box, test::small_tiles(), half);
  const auto kept = rows_of(thin);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), kept.begin(), kept.end()));
  EXPECT_NEAR(static_cast<double>(kept.size()), 0.5 * static_cast<double>(all.size()),
              4 * std::sqrt(0.25 * static_cast<double>(all.size())));
  EXPECT_EQ(thin.stats.thinned + thin.stats.instances, whole.stats.instances);

  // West dense, east empty.
  const PileControl control{
      .density = DensityMask{.area = {{-3, -3}, {3, 3}}, .nx = 2, .ny = 1, .shares = {1, 0}}};
  const Pile west = fill(box, test::small_tiles(), params, control);
  EXPECT_GT(west.stats.instances, all.size() / 3);
  for (const PlacedStone& s : placed_stones(west)) {
    const Vec3 pivot =
        west.tiling.world(Vec3(s.cell) + test::small_tiles()->stones()[s.stone].pivot);
    ASSERT_LT(pivot.x, 0);
    ASSERT_GT(pivot.x, -3);
  }
}

TEST(Fill, IsTheSameForOneAndTwoThreads) {
  for (int round = 0; round < 3; ++round) {
    const auto made_by = [&](int threads) {
      const ThreadLimit limit(threads);
      return fill(random_support(round), test::small_tiles(4), random_params(round)).stones;
    };
    EXPECT_EQ(made_by(1), made_by(2));
  }
}

TEST(Fill, RefusesMasksThatDoNotFitTheirSize) {
  const ShapeSupport box(Box{});
  PileControl control{.density = DensityMask{.area = {{0, 0}, {1, 1}}, .nx = 2, .ny = 2}};
  EXPECT_THROW(fill(box, test::small_tiles(), {.stone_size = {0.2}}, control), Error);
}

}  // namespace
}  // namespace talus
