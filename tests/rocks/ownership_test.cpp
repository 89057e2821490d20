// Every tiling that can be put together is exact: one owner for every voxel, by one rule.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "rocks/global_rule.h"
#include "talus/rocks/contacts.h"

namespace talus {
namespace {

using namespace rocks;
using test::for_each_cell;
using test::Tiling;
using test::varied_params;

constexpr int kCubes = 6;  // along each edge of a tiling

// What a tiling is made of; every kind must fit for every n and variety.
enum class Kind { even, uneven, slabs, needles, gravel, mixed, poisson };
constexpr Kind kKinds[] = {Kind::even,   Kind::uneven, Kind::slabs,  Kind::needles,
                           Kind::gravel, Kind::mixed,  Kind::poisson};

TileParams params_of(Kind kind, int n, Variety variety) {
  TileParams p{.variety = variety, .n = n, .voxels_per_edge = 4 * n, .size_ratio = 1};
  if (kind == Kind::uneven || kind == Kind::mixed) p.size_ratio = 4;
  if (kind == Kind::slabs) p.axis_z = {0.2, 0.2};
  if (kind == Kind::needles) p.axis_x = {5, 5};
  if (kind == Kind::gravel) p.seeds_max = 20;
  if (kind == Kind::poisson) p.placement = SeedPlacement::poisson, p.frames = Frames::bedded;
  if (kind == Kind::mixed) p.colors = 3, p.seeds_max = 3, p.axis_z = {0.3, 1};
  return p;
}

// The owners of a tiling's voxels, found by placing stones.
class Assembly {
 public:
  struct Owner {
    Int3 cell{0};
    std::uint16_t seed = 0;
    std::uint16_t count = 0;
  };

  Assembly(const BlockTable& blocks, const Tiling& tiling)
      : size_(kCubes * blocks.layout().period_voxels()) {
    owners_.resize(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_) *
                   static_cast<std::size_t>(size_));
    const CellLayout& layout = blocks.layout();
    const Int3 margin(layout.period());
    StoneGrid grid;
    for_each_cell(-margin, (kCubes + 1) * margin, [&](const Int3& cell) {
      const std::size_t seeds = tiling.seeds(blocks.seeds(), cell).size();
      for (std::uint16_t k = 0; k < seeds; ++k)
        if (grid.gather(blocks, tiling.key(cell, k)))
          place(grid, layout.voxels_per_cell * cell, {cell, k, 1});
    });
  }

  int size() const { return size_; }
  std::size_t count() const { return owners_.size(); }
  const Owner& owner(std::size_t i) const { return owners_[i]; }
  Int3 voxel(std::size_t i) const {
    const auto v = static_cast<int>(i);
    return {v % size_, v / size_ % size_, v / (size_ * size_)};
  }

 private:
  void place(const StoneGrid& grid, const Int3& corner, const Owner& owner) {
    for (std::size_t i = 0; i < grid.count(); ++i) {
      if (!grid.own()[i]) continue;
      const Int3 v = grid.voxel_at(i) + corner;
      if (std::min({v.x, v.y, v.z}) < 0 || std::max({v.x, v.y, v.z}) >= size_) continue;
      Owner& known = owners_[static_cast<std::size_t>(v.x + size_ * (v.y + size_ * v.z))];
      known = {owner.cell, owner.seed, static_cast<std::uint16_t>(known.count + 1)};
    }
  }

  int size_;
  std::vector<Owner> owners_;
};

class Ownership : public testing::TestWithParam<std::tuple<int, Variety>> {};

// A stone is computed once and placed wherever its colors occur; the global rule knows all seeds
// around each place. Their agreement means that every repetition is the same stone. Small tilings
// are compared in every voxel, others in a sample.
TEST_P(Ownership, EveryVoxelHasOneOwnerAndItIsThatOfTheGlobalRule) {
  const auto [n, variety] = GetParam();
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    const TileParams params = params_of(kind, n, variety);
    const BlockTable blocks(params, static_cast<std::uint64_t>(n), nullptr);
    const Tiling tiling(params, 100 + static_cast<std::uint64_t>(kind));
    const Assembly assembly(blocks, tiling);
    for (std::size_t i = 0; i < assembly.count(); ++i) ASSERT_EQ(assembly.owner(i).count, 1);

    const test::GlobalRule rule(params, blocks.seeds(), tiling, Int3(0), Int3(kCubes));
    const bool small = n == 5 && params.seeds_max == 1;
    const std::size_t step = small ? 1 : assembly.count() / 20'000;
    for (std::size_t i = step / 2; i < assembly.count(); i += step) {
      const Assembly::Owner& owner = assembly.owner(i);
      double owners_score = 0;
      const auto best = rule.strongest(assembly.voxel(i), owner.cell, owner.seed, owners_score);
      if (best.cell == owner.cell && best.seed == owner.seed) continue;
      constexpr double kTie = 1e-6;
      ASSERT_LE(owners_score, best.score * (1 + kTie));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tilings, Ownership,
                         testing::Combine(testing::Values(5, 6, 7),
                                          testing::Values(Variety::aperiodic, Variety::columns,
                                                          Variety::periodic)));

TEST(Distances, OfTwoStonesNeverSumAboveZero) {
  for (const int variant : {2, 5, 8}) {
    const BlockTable blocks(varied_params(variant), 1, nullptr);
    const CellLayout& layout = blocks.layout();
    const Tiling tiling(varied_params(variant), 1);
    std::map<std::array<int, 3>, std::vector<float>> fields;  // all stones' values at a voxel
    StoneGrid grid;
    for_each_cell(Int3(0), Int3(layout.period() + 1), [&](const Int3& cell) {
      if (!grid.gather(blocks, tiling.key(cell, 0))) return;
      for (std::size_t i = 0; i < grid.count(); ++i) {
        const Int3 v = grid.voxel_at(i) + layout.voxels_per_cell * cell;
        fields[{v.x, v.y, v.z}].push_back(grid.distances()[i]);
      }
    });
    std::size_t shared = 0;
    for (auto& [voxel, values] : fields) {
      std::sort(values.rbegin(), values.rend());
      if (values.size() < 2) continue;
      ++shared;
      ASSERT_LE(values[0] + values[1], 0);
    }
    EXPECT_GT(shared, 10000u);
  }
}

// The contacts of one stone, by neighbor.
std::map<std::array<int, 4>, Int3> contacts_of(const BlockTable& blocks, const Tiling& tiling,
                                               const Int3& cell, std::uint16_t seed) {
  StoneGrid grid;
  ContactFinder finder;
  std::map<std::array<int, 4>, Int3> result;
  if (!grid.gather(blocks, tiling.key(cell, seed))) return result;
  for (const Contact& c : finder.find(grid)) {
    const Int3 other = cell + c.cell;
    result[{other.x, other.y, other.z, c.seed}] =
        c.face + 2 * blocks.layout().voxels_per_cell * cell;
  }
  return result;
}

TEST(Contacts, BothStonesFindTheSameFace) {
  std::size_t pairs = 0;
  for (int variant = 0; variant < 9; ++variant) {
    const BlockTable blocks(varied_params(variant), static_cast<std::uint64_t>(variant), nullptr);
    const Tiling tiling(varied_params(variant), 300 + static_cast<std::uint64_t>(variant));
    for_each_cell(Int3(0), Int3(blocks.layout().period()), [&](const Int3& cell) {
      for (const auto& [other, face] : contacts_of(blocks, tiling, cell, 0)) {
        const Int3 neighbor(other[0], other[1], other[2]);
        const auto back =
            contacts_of(blocks, tiling, neighbor, static_cast<std::uint16_t>(other[3]));
        const auto found = back.find({cell.x, cell.y, cell.z, 0});
        ASSERT_NE(found, back.end());
        ASSERT_EQ(found->second, face);
        ++pairs;
      }
    });
  }
  EXPECT_GT(pairs, 1000u);
}

}  // namespace
}  // namespace talus
