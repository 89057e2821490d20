#include "talus/rocks/tile_set.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rocks/tiling.h"
#include "talus/base/parallel.h"
#include "talus/mesh/check.h"
#include "talus/rocks/equal_stones.h"
#include "talus/rocks/stone_maker.h"

namespace talus {
namespace {

TileParams coarse(int n) {
  TileParams p;
  p.n = n;
  p.voxels_per_edge = 4 * n;
  return p;
}

// Varied shapes, few and coarse enough that a whole set is made in a moment.
TileParams small(int variant) {
  TileParams p = test::varied_params(variant);
  p.n = 5;
  p.voxels_per_edge = 30;
  p.seeds_max = std::min(p.seeds_max, 2);
  return p;
}

// c + 3 (n-2) c^2 + 3 (n-2)^2 c^4 + (n-2)^3 c^8, the unique stones with one seed per cell.
std::uint64_t formula(std::uint64_t n, std::uint64_t c) {
  const std::uint64_t m = n - 2, c2 = c * c, c4 = c2 * c2;
  return c + 3 * m * c2 + 3 * m * m * c4 + m * m * m * c4 * c4;
}

// The same where corner colors are constant along z.
std::uint64_t columns_formula(std::uint64_t n, std::uint64_t c) {
  const std::uint64_t m = n - 2, c2 = c * c;
  return (n - 1) * (c + 2 * m * c2 + m * m * c2 * c2);
}

// Unique stones of a layout with one seed in a cell.
std::uint64_t count_stones(const TileParams& params) {
  const rocks::CellLayout layout(params);
  std::uint64_t count = 0;
  for (std::size_t c = 0; c < layout.cell_count(); ++c)
    count += rocks::code_count(layout.stone_corners(layout.cell_at(c)), layout.colors);
  return count;
}

TEST(TileSet, CountsAreThoseOfTheFormula) {
  EXPECT_EQ(formula(5, 2), 7382u);
  EXPECT_EQ(formula(6, 2), 17202u);
  EXPECT_EQ(formula(7, 2), 33262u);
  EXPECT_EQ(columns_formula(5, 2), 680u);
  EXPECT_EQ(columns_formula(9, 2), 6736u);
  for (std::uint64_t n = 5; n <= 9; ++n)
    for (const std::uint64_t colors : {2u, 3u}) {
      TileParams p = coarse(static_cast<int>(n));
      p.colors = static_cast<int>(colors);
      EXPECT_EQ(count_stones(p), formula(n, colors));
      p.variety = Variety::columns;
      EXPECT_EQ(count_stones(p), columns_formula(n, colors));
      p.variety = Variety::periodic;
      EXPECT_EQ(count_stones(p), (n - 1) * (n - 1) * (n - 1));
    }
}

TEST(TileSet, HasEveryStoneOfItsLayout) {
  for (const Variety variety : {Variety::aperiodic, Variety::columns, Variety::periodic}) {
    TileParams p = coarse(5);
    p.variety = variety;
    const TileSet tiles = TileSet::make(p, 1);
    EXPECT_EQ(tiles.stones().size(), count_stones(p));
    EXPECT_EQ(tiles.stats().empty, 0u);
    // Before weathering the stones fill a cube, on average over its colorings.
    const rocks::CellLayout layout(p);
    double voxels = 0;
    for (const Stone& stone : tiles.stones())
      voxels += static_cast<double>(stone.voxel_count) /
                rocks::code_count(layout.stone_corners(stone.cell), layout.colors);
    EXPECT_DOUBLE_EQ(voxels, 16 * 16 * 16);
  }
}

TEST(TileSet, RepeatsAsItsVarietySays) {
  TileParams p = coarse(5);
  const int period = p.n - 1;
  const auto differing = [&](Variety variety, const Int3& step) {
    p.variety = variety;
    const TileSet tiles = TileSet::make(p, 1);
    int count = 0;
    test::for_each_cell(Int3(-8), Int3(8), [&](const Int3& cell) {
      count += tiles.stones_at(cell).first != tiles.stones_at(cell + period * step).first;
    });
    return count;
  };
  const Int3 x(1, 0, 0), z(0, 0, 1);
  EXPECT_GT(differing(Variety::aperiodic, x), 1000);
  EXPECT_GT(differing(Variety::aperiodic, z), 1000);
  EXPECT_GT(differing(Variety::columns, x), 1000);
  EXPECT_EQ(differing(Variety::columns, z), 0);
  EXPECT_EQ(differing(Variety::periodic, x), 0);
  EXPECT_EQ(differing(Variety::periodic, z), 0);
}

TEST(TileSet, MeshesAreClosedManifoldAndOutward) {
  for (const int variant : {1, 2, 4, 5, 7, 8}) {
    const TileSet tiles = TileSet::make(small(variant), 3);
    for (const Stone& stone : tiles.stones()) {
      if (!stone.mesh) continue;
      const MeshCheck check = check_mesh(*stone.mesh);
      ASSERT_TRUE(check.closed() && check.manifold() && check.oriented());
      ASSERT_GT(stone.volume, 0);
      ASSERT_EQ(stone.mesh->normals.size(), stone.mesh->positions.size());
      for (const Vec3f& p : stone.mesh->positions) ASSERT_LE(glm::length(p), stone.radius + 1e-6);
    }
  }
}

std::string digest(const TileSet& tiles) {
  Digest d;
  for (const Stone& stone : tiles.stones()) {
    d.add(stone.volume);
    d.add(std::span(stone.solid.bits));
    if (stone.mesh) d.add(std::span(stone.mesh->positions));
  }
  return d.hex();
}

TEST(TileSet, IsTheSameForAnyNumberOfThreads) {
  const TileParams params = small(4);
  TileParams round = small(1);
  round.weathering.roundness = 0.3;
  round.size_ratio = 3;
  for (const TileParams& p : {params, round}) {
    const auto made_by = [&](int threads) {
      const ThreadLimit limit(threads);
      return digest(TileSet::make(p, 9));
    };
    const auto one = made_by(1);
    // Which thread makes a stone, and after which other, changes from run to run.
    for (int run = 0; run < 5; ++run) EXPECT_EQ(made_by(2), one);
  }
  EXPECT_NE(digest(TileSet::make(params, 9)), digest(TileSet::make(params, 10)));
}

// Stones that are recognized as equal before anything is made of them come out equal.
TEST(TileSet, EqualStonesAreMadeEqual) {
  const TileParams params = small(1);
  const rocks::BlockTable blocks(params, 1, nullptr);
  std::vector<rocks::StoneKey> keys;
  for (std::uint32_t code = 0; code < 256; ++code) keys.push_back({Int3(1, 2, 3), code, 0});
  const std::vector<std::uint32_t> first = rocks::find_equal_stones(blocks, keys);
  rocks::StoneMaker maker(params, blocks);
  std::size_t distinct = 0;
  std::vector<Stone> made;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    made.push_back(maker.make(keys[i]).stone);
    const Stone &stone = made[i], &same = made[first[i]];
    ASSERT_EQ(stone.mesh->positions, same.mesh->positions);
    ASSERT_EQ(stone.mesh->normals, same.mesh->normals);
    ASSERT_EQ(stone.solid.bits, same.solid.bits);
    ASSERT_EQ(stone.contacts.size(), same.contacts.size());
    for (std::size_t k = 0; k < stone.contacts.size(); ++k) {
      ASSERT_EQ(stone.contacts[k].face, same.contacts[k].face);
      ASSERT_EQ(stone.contacts[k].cell, same.contacts[k].cell);
    }
    distinct += first[i] == i;
  }
  EXPECT_LT(distinct, keys.size());
}

TEST(TileSet, StonesFillSpaceUntilTheyWeather) {
  TileParams p = coarse(5);
  p.voxels_per_edge = 50;
  p.weathering.depth = 0;
  const TileSet sharp = TileSet::make(p, 1);
  p.weathering.depth = 0.15;
  const TileSet worn = TileSet::make(p, 1);
  EXPECT_LT(sharp.stats().void_fraction, 0.03);  // marching cubes cut the corners of cells
  EXPECT_GT(worn.stats().void_fraction, 0.15);
  EXPECT_LT(worn.stats().void_fraction, 0.5);
  EXPECT_GT(sharp.stats().contacts_mean, 13);
}

TEST(TileSet, TellsWhatItsPhasesCost) {
  std::vector<Stage> phases;
  const StageTimer timer;
  TileSet::make(coarse(5), 1, nullptr, &phases);
  const double whole = timer.stop("").wall_s;
  double sum = 0;
  for (const Stage& phase : phases) {
    EXPECT_FALSE(phase.name.empty());
    EXPECT_GT(phase.wall_s, 0) << phase.name;
    sum += phase.wall_s;
  }
  EXPECT_EQ(phases.size(), 4u);
  EXPECT_GT(sum, 0.5 * whole);
  EXPECT_LE(sum, whole);
}

TEST(TileSet, WeatheringKeepsContacts) {
  const TileSet tiles = TileSet::make(TileParams{}, 1);
  EXPECT_LT(tiles.stats().contacts_lost_fraction, 0.01);
  EXPECT_GE(tiles.stats().contacts_min, 5u);
  EXPECT_EQ(tiles.stats().below_three_fraction, 0);
  EXPECT_EQ(tiles.stats().empty, 0u);
}

TEST(TileSet, DoublingTheResolutionKeepsTheShape) {
  TileParams p = coarse(5);
  p.voxels_per_edge = 30;
  const TileSet low = TileSet::make(p, 1);
  p.voxels_per_edge = 60;
  const TileSet high = TileSet::make(p, 1);
  EXPECT_NEAR(low.stats().void_fraction, high.stats().void_fraction, 0.05);
  double difference = 0;
  for (std::size_t i = 0; i < low.stones().size(); ++i)
    difference += std::abs(low.stones()[i].volume - high.stones()[i].volume);
  EXPECT_LT(difference / static_cast<double>(low.stones().size()), 0.06);
}

TEST(TileSet, FlatAxisMakesFlatStones) {
  TileParams p = coarse(5);
  p.voxels_per_edge = 50;
  p.axis_z = {0.45, 0.45};
  p.size_ratio = 1;
  const TileSet tiles = TileSet::make(p, 1);
  // Compactness of a sphere is 1; that of the round default about 0.8.
  double round = 0, flat = 0;
  const auto compactness = [](const Stone& s) {
    return s.volume / (4.18879 * s.radius * s.radius * s.radius);
  };
  p.axis_z = {1, 1};
  const TileSet rounds = TileSet::make(p, 1);
  for (const Stone& s : tiles.stones()) flat += compactness(s);
  for (const Stone& s : rounds.stones()) round += compactness(s);
  EXPECT_LT(flat, 0.75 * round);
}

TEST(TileSet, CancellingStopsIt) {
  Job job;
  job.cancel();
  EXPECT_THROW(TileSet::make(TileParams{}, 1, &job), Cancelled);
}

std::string refusal(auto&& change) {
  TileParams p;
  change(p);
  try {
    validate_tiles(p);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

TEST(TileParams, RefusalsSayWhatWouldDo) {
  EXPECT_EQ(refusal([](TileParams& p) { p.n = 4; }),
            "tiles.n = 4 cells is out of range; it must be from 5 to 16 cells");
  EXPECT_EQ(refusal([](TileParams& p) { p.voxels_per_edge = 53; }),
            "tiles.voxels_per_edge = 53 does not divide a cube of n = 5 cells evenly; it must be a "
            "multiple of 10, for example 50 or 60");
  EXPECT_EQ(refusal([](TileParams& p) {
              p.variety = Variety::periodic;
              p.voxels_per_edge = 53;
            }),
            "tiles.voxels_per_edge = 53 does not divide a cube of n = 5 cells evenly; it must be a "
            "multiple of 5, for example 50 or 55");
  EXPECT_EQ(refusal([](TileParams& p) { p.size_ratio = 0.5; }),
            "tiles.size_ratio = 0.5 is out of range; it must be from 1 to 4");
  EXPECT_EQ(refusal([](TileParams& p) {
              p.seeds_min = 3;
              p.seeds_max = 2;
            }),
            "tiles.seeds_min = 3 is above tiles.seeds_max = 2");
  EXPECT_EQ(refusal([](TileParams& p) {
              p.axis_x = {2, 1};
            }),
            "tiles.axis_x: range [2, 1] is reversed; give the smaller value first");
  EXPECT_EQ(refusal([](TileParams& p) { p.contacts.blend = 0.1; }),
            "tiles.contacts.blend = 0.1 cells is below tiles.contacts.radius = 0.14 cells");
  EXPECT_EQ(refusal([](TileParams& p) {
              p.bedding = {0, 0, 0};
            }),
            "tiles.bedding = [0, 0, 0] is no direction; [0, 0, 1] makes level beds");
  EXPECT_EQ(refusal([](TileParams& p) { p.colors = 3; }), "");
  EXPECT_EQ(refusal([](TileParams& p) {
              p.colors = 3;
              p.seeds_max = 40;
            }),
            "tiles of n = 5, 3 colors, 50 voxels per edge and up to 40 stones in a cell take 9 GB; "
            "lower one of them, at most 6 GB are possible");
}

}  // namespace
}  // namespace talus
