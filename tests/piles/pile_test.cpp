#include "talus/piles/pile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/field/shape.h"
#include "talus/piles/pile_check.h"
#include "talus/piles/pile_edits.h"

namespace talus {
namespace {

std::shared_ptr<const TileSet> coarse_tiles() {
  static const auto tiles = [] {
    TileParams params;
    params.voxels_per_edge = 40;
    return std::make_shared<const TileSet>(TileSet::make(params, 1));
  }();
  return tiles;
}

PileParams with_size(double metres) {
  return {.stone_size = {metres, RelativeLength::Unit::metres}};
}

ShapeSupport figure() {
  return ShapeSupport(
      Combination{Combination::Rule::join,
                  0.2,
                  {Sphere{{0, 0, 1}, 1}, Capsule{{0, 0, 1}, {0, 1.5, 2}, 0.6, 0.3}}});
}

// Forgets how to answer for boxes, so that every anchor is asked for.
class PointwiseSupport final : public Support {
 public:
  explicit PointwiseSupport(const Support& support) : support_(support) {}
  bool contains(const Vec3& p) const override { return support_.contains(p); }
  BoxState classify(const Box3&) const override { return BoxState::mixed; }
  Box3 bounds() const override { return support_.bounds(); }

 private:
  const Support& support_;
};

std::vector<std::array<std::int64_t, 4>> table_of(const Pile& pile) {
  std::vector<std::array<std::int64_t, 4>> rows;
  for (const PlacedStone& s : placed_stones(pile))
    rows.push_back({s.cell.z, s.cell.y, s.cell.x, s.stone});
  std::sort(rows.begin(), rows.end());
  return rows;
}

TEST(Pile, CountMatchesTheVolumeOfTheSupport) {
  const ShapeSupport sphere(Sphere{{3, -2, 7}, 1});
  const Pile pile = fill(sphere, coarse_tiles(), with_size(0.1));
  const double cells = 4.0 / 3 * std::numbers::pi * 1000;
  EXPECT_NEAR(static_cast<double>(pile.stats.instances), cells, 0.04 * cells);
}

TEST(Pile, BoxAnswersGiveTheSamePileAsAskingForEveryAnchor) {
  const ShapeSupport support = figure();
  EXPECT_EQ(table_of(fill(support, coarse_tiles(), with_size(0.15))),
            table_of(fill(PointwiseSupport(support), coarse_tiles(), with_size(0.15))));
}

TEST(Pile, EveryStoneReachesTheShareOfAnchorsInside) {
  const ShapeSupport support = figure();
  for (const double fraction : {0.2, 0.5, 1.0}) {
    PileParams params = with_size(0.2);
    params.inside_fraction = fraction;
    const Pile pile = fill(support, coarse_tiles(), params);
    ASSERT_GT(pile.stats.instances, 0u);
    for (const PlacedStone& placed : placed_stones(pile)) {
      const Stone& stone = coarse_tiles()->stones()[placed.stone];
      int anchors = 1;
      int inside = support.contains(pile.tiling.world(Vec3(placed.cell) + stone.seed_position));
      const StoneSolid& solid = stone.solid;
      for (int z = 0; z < solid.size.z; ++z)
        for (int y = 0; y < solid.size.y; ++y)
          for (int x = 0; x < solid.size.x; ++x) {
            if (!solid.test(x, y, z)) continue;
            ++anchors;
            const Vec3 center = (Vec3(solid.min + Int3(x, y, z)) + 0.5) / 8.0;
            inside += support.contains(pile.tiling.world(Vec3(placed.cell) + center));
          }
      ASSERT_GE(inside, fraction * anchors - 1e-9);
    }
  }
}

TEST(Pile, StonesAreThoseOfTheTilingEachOnce) {
  const Pile pile = fill(figure(), coarse_tiles(), with_size(0.15));
  const auto rows = table_of(pile);
  EXPECT_EQ(std::set(rows.begin(), rows.end()).size(), rows.size());
  for (const PlacedStone& placed : placed_stones(pile)) {
    const Int3 local = coarse_tiles()->stones()[placed.stone].cell;
    for (int axis = 0; axis < 3; ++axis) ASSERT_EQ((placed.cell[axis] - local[axis]) % 4, 0);
  }
}

TEST(Pile, RepeatsAsItsTilesDo) {
  const ShapeSupport box(Box{.center = {0, 0, 0}, .size = {1, 1, 1}});
  for (const Variety variety : {Variety::columns, Variety::periodic}) {
    const TileParams params{.variety = variety, .n = 5, .voxels_per_edge = 20};
    const auto tiles = std::make_shared<const TileSet>(TileSet::make(params, 1));
    const Pile pile = fill(box, tiles, with_size(1.0 / 16));
    EXPECT_LE(pile.stats.unique, tiles->stones().size());
    // A stone well inside is there again one cube higher.
    std::map<std::array<int, 3>, std::uint32_t> placed;
    for (const PlacedStone& s : placed_stones(pile))
      placed[{s.cell.x, s.cell.y, s.cell.z}] = s.stone;
    for (int i = 0; i < 512; ++i) {
      const std::array<int, 3> cell{4 + i % 8, 4 + i / 8 % 8, 2 + i / 64};
      ASSERT_TRUE(placed.contains(cell));
      ASSERT_EQ(placed.at(cell), (placed.at({cell[0], cell[1], cell[2] + 4})));
    }
  }
}

TEST(Pile, SurfaceOnlyLeavesOutDeepStonesAndNoOther) {
  const ShapeSupport sphere(Sphere{{0, 0, 0}, 1});
  PileParams params = with_size(0.1);
  const Pile whole = fill(sphere, coarse_tiles(), params);
  params.surface_only = true;
  const Pile shell = fill(sphere, coarse_tiles(), params);
  EXPECT_EQ(shell.stats.instances + shell.stats.hidden, whole.stats.instances);
  EXPECT_GT(shell.stats.hidden, whole.stats.instances / 20);
  const auto all = table_of(whole), kept = table_of(shell);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), kept.begin(), kept.end()));
  for (const PlacedStone& placed : placed_stones(whole)) {
    const Stone& stone = coarse_tiles()->stones()[placed.stone];
    const Vec3 pivot = whole.tiling.world(Vec3(placed.cell) + stone.pivot);
    const std::array<std::int64_t, 4> row = {placed.cell.z, placed.cell.y, placed.cell.x,
                                             placed.stone};
    const bool is_kept = std::binary_search(kept.begin(), kept.end(), row);
    ASSERT_TRUE(is_kept || glm::length(pivot) < 0.85);
  }
}

// Which stones of a pile own the voxels of its tiling.
class VoxelOwners {
 public:
  explicit VoxelOwners(const Pile& pile)
      : tiling_(pile.tiling),
        per_cell_(pile.tiles->params().voxels() / pile.tiles->params().n),
        first_(std::numeric_limits<int>::max()),
        last_(std::numeric_limits<int>::min()) {
    const std::vector<PlacedStone> placed = placed_stones(pile);
    const auto solid_of = [&](const PlacedStone& s) -> const StoneSolid& {
      return pile.tiles->stones()[s.stone].solid;
    };
    for (const PlacedStone& s : placed) {
      first_ = glm::min(first_, per_cell_ * s.cell + solid_of(s).min);
      last_ = glm::max(last_, per_cell_ * s.cell + solid_of(s).min + solid_of(s).size);
    }
    size_ = last_ - first_;
    owners_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                   static_cast<std::size_t>(size_.z));
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const StoneSolid& solid = solid_of(placed[i]);
      for (int z = 0; z < solid.size.z; ++z)
        for (int y = 0; y < solid.size.y; ++y)
          for (int x = 0; x < solid.size.x; ++x)
            if (solid.test(x, y, z))
              owners_[index(per_cell_ * placed[i].cell + solid.min + Int3(x, y, z) - first_)] =
                  static_cast<std::uint32_t>(i + 1);
    }
  }

  // The first stone on a line, plus one; 0 if it meets none.
  std::uint32_t first_on(const Vec3& from, const Vec3& direction, double length) const {
    const double voxel = tiling_.cell_size / per_cell_;
    for (double t = 0; t < length; t += 0.3 * voxel) {
      const Int3 v = Int3(glm::floor((from + t * direction - tiling_.origin) / voxel)) - first_;
      if (!CubeBox{Int3(0), size_}.contains(v)) continue;
      if (const std::uint32_t owner = owners_[index(v)]) return owner;
    }
    return 0;
  }

 private:
  std::size_t index(const Int3& v) const {
    return static_cast<std::size_t>(v.x) +
           static_cast<std::size_t>(size_.x) *
               (static_cast<std::size_t>(v.y) +
                static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(v.z));
  }

  Tiling tiling_;
  int per_cell_;
  Int3 first_, last_, size_{0};
  std::vector<std::uint32_t> owners_;
};

TEST(Pile, WhatSurfaceOnlyLeavesOutIsNotSeen) {
  PileParams params = with_size(0.07);
  const Pile whole = fill(figure(), coarse_tiles(), params);
  params.surface_only = true;
  const auto kept = table_of(fill(figure(), coarse_tiles(), params));
  std::vector<bool> is_hidden = {false};
  for (const PlacedStone& s : placed_stones(whole))
    is_hidden.push_back(
        !std::binary_search(kept.begin(), kept.end(),
                            std::array<std::int64_t, 4>{s.cell.z, s.cell.y, s.cell.x, s.stone}));
  ASSERT_GT(std::count(is_hidden.begin(), is_hidden.end(), true), 500);

  // Ten parallel views of the figure, spread over the sphere.
  const VoxelOwners owners(whole);
  const Box3 box = figure().bounds();
  const double reach = 0.6 * glm::length(box.size());
  int hits = 0, wrong = 0;
  for (int view = 0; view < 10; ++view) {
    const double z = 0.9 - 0.2 * view, angle = 2.4 * view, r = std::sqrt(1 - z * z);
    const Vec3 toward = -Vec3(r * std::cos(angle), r * std::sin(angle), z);
    const Vec3 right = glm::normalize(glm::cross(toward, Vec3(0, 0, 1)));
    const Vec3 up = glm::cross(right, toward);
    constexpr int kPixels = 150;
    for (int y = 0; y < kPixels; ++y)
      for (int x = 0; x < kPixels; ++x) {
        const Vec2 at = reach * (2.0 * Vec2(x + 0.5, y + 0.5) / double{kPixels} - 1.0);
        const std::uint32_t stone = owners.first_on(
            box.center() + at.x * right + at.y * up - reach * toward, toward, 2 * reach);
        hits += stone > 0;
        wrong += is_hidden[stone];
      }
  }
  EXPECT_GT(hits, 30'000);
  EXPECT_LE(wrong, 1e-4 * hits);
}

TEST(Pile, StonesTouchEachOther) {
  const Pile pile = fill(figure(), coarse_tiles(), with_size(0.15));
  EXPECT_GT(check_pile(pile).contacts_mean, 8);
  EXPECT_EQ(pile.stats.isolated, 0u);
}

TEST(Pile, IsTheSameForAnyNumberOfThreads) {
  const auto made_by = [&](int threads) {
    const ThreadLimit limit(threads);
    return table_of(fill(figure(), coarse_tiles(), with_size(0.12)));
  };
  EXPECT_EQ(made_by(1), made_by(2));
}

TEST(Pile, InstancesShareTheTileSetsMeshes) {
  const Pile pile = fill(figure(), coarse_tiles(), with_size(0.12));
  const InstanceTable table = instances(pile);
  ASSERT_EQ(table.instances.size(), pile.stats.instances);
  std::set<const TriangleMesh*> meshes;
  for (const Stone& stone : coarse_tiles()->stones()) meshes.insert(stone.mesh.get());
  std::vector<bool> used(table.prototypes.size());
  for (const Instance& i : table.instances) used[i.prototype] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  EXPECT_EQ(std::set(table.prototypes.begin(), table.prototypes.end()).size(),
            table.prototypes.size());
  for (const auto& prototype : table.prototypes) ASSERT_TRUE(meshes.contains(prototype.get()));
  EXPECT_TRUE(std::is_sorted(
      table.instances.begin(), table.instances.end(),
      [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; }));
  // Most of a stone lies inside the support, the rest near it.
  const Box3 box = bounds(table);
  EXPECT_GT(box.min.z, pile.tiling.origin.z - 0.12);
  EXPECT_LT(box.max.z, figure().bounds().max.z + 0.12);
}

std::string refusal(const Support& support, const PileParams& params) {
  try {
    fill(support, coarse_tiles(), params);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

TEST(Pile, AStoneThatIsTooLargeIsToldTheLargestThatFits) {
  const ShapeSupport sphere(Sphere{{0, 0, 0}, 1});
  const std::string message = refusal(sphere, with_size(9));
  EXPECT_NE(message.find("stone_size = 9 m is too large"), std::string::npos) << message;
  const auto about = message.find("about ");
  ASSERT_NE(about, std::string::npos) << message;
  const double largest = std::stod(message.substr(about + 6));
  EXPECT_GT(largest, 0.5);
  EXPECT_GT(fill(sphere, coarse_tiles(), with_size(0.99 * largest)).stats.instances, 0u);
}

TEST(Pile, MoreStonesThanMemoryAllowsAreRefusedWithTheirCount) {
  PileParams params = with_size(0.01);
  params.memory_limit = 1 << 20;
  for (const double size : {0.01, 1e-4, 1e-5}) {
    params.stone_size.value = size;
    try {
      fill(ShapeSupport(Box{}), coarse_tiles(), params);
      ADD_FAILURE() << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::job);
      const std::string message = error.what();
      const auto about = message.find("asks for about ");
      ASSERT_NE(about, std::string::npos) << message;
      const double cells = 1 / (size * size * size);
      EXPECT_NEAR(std::stod(message.substr(about + 15)), cells, 0.3 * cells) << message;
      const auto least = message.find("at least about ");
      ASSERT_NE(least, std::string::npos) << message;
      // What it names is possible, within a little.
      params.stone_size.value = 1.2 * std::stod(message.substr(least + 15));
      EXPECT_GT(fill(ShapeSupport(Box{}), coarse_tiles(), params).stats.instances, 0u);
    }
  }
}

TEST(Pile, AnEndlessSupportIsRefused) {
  EXPECT_NE(refusal(ShapeSupport(HalfSpace{}), {}).find("a support with an end"),
            std::string::npos);
  EXPECT_NE(refusal(ShapeSupport(HalfSpace{}), with_size(1)).find("a support with an end"),
            std::string::npos);
}

TEST(Pile, OfStonesThatKeepNoContactTellsWhatToLower) {
  TileParams params{.voxels_per_edge = 20};
  params.contacts.discard_fraction = 1;
  params.weathering.depth = 0.25;
  const auto tiles = std::make_shared<const TileSet>(TileSet::make(params, 1));
  try {
    fill(ShapeSupport(Sphere{.radius = 3}), tiles, with_size(1));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("lower contacts.discard_fraction"), std::string::npos)
        << error.what();
  }
}

TEST(Pile, IsNeverEmpty) {
  // Two places for one stone each: alone, each would touch no other.
  const ShapeSupport pair(Combination{
      Combination::Rule::join, 0, {Sphere{{0.5, 0, 0}, 0.45}, Sphere{{9.5, 0, 0}, 0.45}}});
  int refused = 0;
  for (double size = 0.5; size < 1.5; size += 0.05) {
    const std::string message = refusal(pair, with_size(size));
    if (message.empty()) {
      EXPECT_GT(fill(pair, coarse_tiles(), with_size(size)).stats.instances, 0u);
      continue;
    }
    ++refused;
    const auto about = message.find("about ");
    ASSERT_NE(about, std::string::npos) << message;
    EXPECT_LT(std::stod(message.substr(about + 6)), size);
  }
  EXPECT_GT(refused, 5);
}

TEST(Pile, CancellingStopsIt) {
  Job job;
  job.cancel();
  EXPECT_THROW(fill(figure(), coarse_tiles(), with_size(0.2), &job), Cancelled);
}

}  // namespace
}  // namespace talus
