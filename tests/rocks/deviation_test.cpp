// What tiles tell about their distance from the unrestricted diagram is what can be found by
// trying.
#include "talus/rocks/deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rocks/tiling.h"

namespace talus {
namespace {

using namespace rocks;
using test::for_each_cell;

// A seed in a cell relative to a block.
struct Rival {
  Vec3f corner;
  const Seed* seed;
  float distance(const Vec3f& at) const {
    const Vec3f p = at - corner;
    return seed->distance(p.x, p.y, p.z);
  }
};

// The seeds around a block that do not compete in it, for any colors of the corners that the block
// does not touch.
std::vector<Rival> rivals_of(const BlockTable& table, std::size_t index) {
  constexpr int kRings = 3;
  const Block& block = table.blocks()[index];
  const CellLayout& layout = table.layout();
  const CornerBox own = table.places()[index].type.corners();
  std::vector<Rival> rivals;
  const auto add = [&](const Int3& cell) {
    if (!block.candidates_of(cell).empty()) return;
    Int3 cube;
    for (int axis = 0; axis < 3; ++axis) cube[axis] = floor_div(cell[axis], layout.period());
    const Int3 local = cell - layout.period() * cube;
    const CornerBox box = layout.seed_corners(local);
    for (std::uint32_t code = 0; code < code_count(box, layout.colors); ++code) {
      bool possible = true;
      for_each_cell(box.first, box.first + box.count, [&](const Int3& corner) {
        const Int3 at = layout.colored_corner(cube + corner);
        for (int axis = 0; axis < 3; ++axis)
          if (at[axis] < 0 || at[axis] >= own.count[axis]) return;
        possible &= decode_color(box, layout.colors, code, corner) ==
                    decode_color(own, layout.colors, table.places()[index].code, at);
      });
      if (!possible) continue;
      for (const Seed& seed : table.seeds().seeds(local, code))
        rivals.push_back({Vec3f(layout.voxels_per_cell * cell), &seed});
    }
  };
  for_each_cell(block.first_cell - kRings, block.first_cell + block.cells + kRings, add);
  return rivals;
}

double try_everything(const BlockTable& table) {
  const CellLayout& layout = table.layout();
  double share = 0;
  for (std::size_t b = 0; b < table.blocks().size(); ++b) {
    const Block& block = table.blocks()[b];
    const std::vector<Rival> rivals = rivals_of(table, b);
    int beaten = 0;
    block.for_each_run([&](const Int3& first, int length, std::uint32_t c) {
      const Candidate& candidate = block.candidates[c];
      const Rival owner{Vec3f(layout.voxels_per_cell * candidate.cell), candidate.form};
      for (int k = 0; k < length; ++k) {
        const Vec3f at = Vec3f(first + Int3(k, 0, 0)) + 0.5f;
        const float owners = owner.distance(at);
        beaten += std::any_of(rivals.begin(), rivals.end(),
                              [&](const Rival& rival) { return rival.distance(at) < owners; });
      }
    });
    share +=
        static_cast<double>(beaten) / code_count(table.places()[b].type.corners(), layout.colors);
  }
  return share / std::pow(layout.period_voxels(), 3);
}

TEST(Deviation, IsWhatTryingEverySeedOfEveryColoringFinds) {
  for (const int kind : {0, 1, 2, 3}) {
    TileParams params{.variety = Variety::columns, .n = 5, .voxels_per_edge = 20};
    if (kind == 1) params.size_ratio = 4;
    if (kind == 2) params.axis_z = {0.5, 0.5}, params.seeds_max = 2;
    if (kind == 3) params.colors = 3, params.axis_x = {2, 2};
    const BlockTable table(params, 1, nullptr);
    const double told = deviation_bound(table);
    EXPECT_GT(told, 0);
    EXPECT_EQ(told, try_everything(table)) << kind;
  }
}

double bound(int n, Variety variety, double size_ratio, double flat = 1) {
  return deviation_bound(BlockTable({.variety = variety,
                                     .n = n,
                                     .voxels_per_edge = 4 * n,
                                     .size_ratio = size_ratio,
                                     .axis_z = {flat, flat}},
                                    1, nullptr));
}

TEST(Deviation, IsSmallForRoundStonesAndVanishesAsCornersFixMore) {
  EXPECT_LT(bound(5, Variety::aperiodic, 1), 0.003);
  EXPECT_LT(bound(5, Variety::aperiodic, 4), 0.02);
  EXPECT_GT(bound(5, Variety::aperiodic, 1, 0.2), kMuchDeviation);
  EXPECT_EQ(bound(7, Variety::aperiodic, 1), 0);
  EXPECT_EQ(bound(7, Variety::aperiodic, 4), 0);
  EXPECT_LT(bound(7, Variety::aperiodic, 1, 0.2), 0.01);
  EXPECT_EQ(bound(5, Variety::periodic, 4), 0);
}

TEST(Deviation, NamesAnNThatWouldDo) {
  TileParams params{
      .variety = Variety::columns, .n = 5, .voxels_per_edge = 20, .axis_z = {0.2, 0.2}};
  const TileSet tiles = TileSet::make(params, 1);
  EXPECT_GT(tiles.stats().deviation_bound, kMuchDeviation);
  ASSERT_TRUE(tiles.stats().sufficient_n);
  params.n = *tiles.stats().sufficient_n;
  params.voxels_per_edge = std::nullopt;
  const TileSet better = TileSet::make(params, 1);
  EXPECT_LT(better.stats().deviation_bound, kMuchDeviation);
  EXPECT_FALSE(better.stats().sufficient_n);
}

}  // namespace
}  // namespace talus
