// What the author's controls of contacts and weathering do to the stones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rocks/tiling.h"
#include "talus/base/job.h"
#include "talus/rocks/contacts.h"
#include "talus/rocks/stone_maker.h"
#include "talus/rocks/variation.h"

namespace talus {
namespace {

TileParams params_of(int voxels_per_cell) {
  TileParams p;
  p.voxels_per_edge = p.n * voxels_per_cell;
  p.size_ratio = 1;
  return p;
}

class Warnings : public Job {
 public:
  void warn(std::string_view message) override { text += message; }
  std::string text;
};

// 1 for a sphere.
double sphericity(const TriangleMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return std::cbrt(36 * std::numbers::pi * std::pow(signed_volume(mesh), 2)) / area;
}

double mean_sphericity(const TileParams& params) {
  const rocks::BlockTable blocks(params, 1, nullptr);
  rocks::StoneMaker maker(params, blocks);
  double sum = 0;
  constexpr int kStones = 200;
  for (std::uint32_t code = 0; code < kStones; ++code)
    sum += sphericity(*maker.make({Int3(1 + code % 3, 2, 2), code, 0}).stone.mesh);
  return sum / kStones;
}

TEST(Contacts, AreLostRarely) {
  TileParams even = params_of(10);
  const TileStats evenly = TileSet::make(even, 1).stats();
  EXPECT_LE(evenly.contacts_lost_fraction, 0.002);
  EXPECT_GE(evenly.contacts_min, 3u);
  TileParams mixed = params_of(10);
  mixed.size_ratio = 4;
  EXPECT_LE(TileSet::make(mixed, 1).stats().contacts_lost_fraction, 0.02);
}

TEST(Contacts, AreDiscardedByBothStonesOrByNone) {
  const rocks::BlockTable blocks(params_of(6), 1, nullptr);
  const test::Tiling tiling(params_of(6), 7);
  rocks::StoneGrid grid;
  rocks::ContactFinder finder(0.3);
  const auto contacts_at = [&](const Int3& cell) {
    grid.gather(blocks, tiling.key(cell, 0));
    return finder.find(grid);
  };
  int contacts = 0, discarded = 0;
  test::for_each_cell(Int3(-2), Int3(6), [&](const Int3& cell) {
    for (const rocks::Contact& contact : contacts_at(cell)) {
      int found = 0;
      for (const rocks::Contact& back : contacts_at(cell + contact.cell))
        if (back.cell == -contact.cell) {
          ++found;
          ASSERT_EQ(back.discarded, contact.discarded);
        }
      ASSERT_EQ(found, 1);
      ++contacts;
      discarded += contact.discarded;
    }
  });
  EXPECT_NEAR(discarded / static_cast<double>(contacts), 0.3, 0.03);
}

TEST(Contacts, DiscardingThemOpensThePileAndWarns) {
  TileParams params = params_of(6);
  const double before = TileSet::make(params, 1).stats().void_fraction;
  params.contacts.discard_fraction = 0.5;
  Warnings job;
  const TileStats after = TileSet::make(params, 1, &job).stats();
  EXPECT_GT(after.void_fraction, before + 0.02);
  EXPECT_GT(after.contacts_lost_fraction, 0.1);
  EXPECT_EQ(job.text, "tiles.contacts.discard_fraction = 0.5: stones may float");
}

TEST(Contacts, AGaussianHoldsWeatheringOff) {
  TileParams params = params_of(6);
  params.contacts.gaussian_radius = 0.1;
  const TileStats narrow = TileSet::make(params, 1).stats();
  params.contacts.gaussian_radius = 0.4;
  const TileStats wide = TileSet::make(params, 1).stats();
  EXPECT_LT(wide.void_fraction, narrow.void_fraction - 0.02);
  EXPECT_LT(wide.contacts_lost_fraction, 0.01);
}

// Eight stones in a cell of twice the edge are the stones of single cells again, nearly: seeds fall
// less evenly.
TEST(Weathering, GravelWearsLikeBouldersOfItsSize) {
  TileParams gravel = params_of(12);
  gravel.seeds_min = gravel.seeds_max = 8;
  const double boulders = TileSet::make(params_of(6), 1).stats().void_fraction;
  EXPECT_NEAR(TileSet::make(gravel, 1).stats().void_fraction, boulders, 0.08);
}

TEST(Weathering, ReachesTheVoidFractionAskedFor) {
  TileParams params = params_of(6);
  for (const double target : {0.15, 0.3}) {
    params.weathering.void_fraction = target;
    Warnings job;
    EXPECT_NEAR(TileSet::make(params, 1, &job).stats().void_fraction, target, 0.02);
    EXPECT_EQ(job.text, "");
  }
}

TEST(Weathering, TellsTheVoidFractionThatCanBeReached) {
  TileParams params = params_of(6);
  params.contacts = {.radius = 0.4, .blend = 0.5};
  params.weathering.void_fraction = 0.95;
  Warnings job;
  const double reached = TileSet::make(params, 1, &job).stats().void_fraction;
  const std::string start =
      "tiles.weathering.void_fraction = 0.95 cannot be reached with these stones and contacts; the "
      "largest possible is ";
  ASSERT_EQ(job.text.substr(0, start.size()), start);
  EXPECT_NEAR(std::stod(job.text.substr(start.size())), reached, 0.02);
}

TEST(Weathering, RoundnessMakesStonesRounder) {
  for (const double axis_z : {1.0, 0.4}) {
    TileParams params = params_of(10);
    params.axis_z = {axis_z, axis_z};
    params.weathering.depth = 0.05;
    double last = mean_sphericity(params);
    for (const double roundness : {0.3, 0.6, 1.0}) {
      params.weathering.roundness = roundness;
      const double rounder = mean_sphericity(params);
      EXPECT_GT(rounder, last) << axis_z << ' ' << roundness;
      last = rounder;
    }
    EXPECT_GT(last, axis_z == 1 ? 0.9 : 0.8);
  }
}

TEST(Weathering, RoundnessLooksTheSameAtEveryResolution) {
  TileParams params = params_of(8);
  params.weathering.roundness = 1;
  const double coarse = TileSet::make(params, 1).stats().void_fraction;
  params.voxels_per_edge = 2 * params.voxels();
  EXPECT_NEAR(TileSet::make(params, 1).stats().void_fraction, coarse, 0.06);
}

TEST(Weathering, VariationSpreadsDepthAndKeepsItsMean) {
  TileParams params = params_of(6);
  const TileSet even = TileSet::make(params, 1);
  params.weathering.variation = 0.8;
  const TileSet uneven = TileSet::make(params, 1);
  EXPECT_NEAR(uneven.stats().void_fraction, even.stats().void_fraction, 0.03);
  const auto spread = [](const TileSet& tiles) {
    double sum = 0, squares = 0;
    for (const Stone& stone : tiles.stones()) {
      const double left = stone.volume / static_cast<double>(stone.voxel_count);
      sum += left;
      squares += left * left;
    }
    const auto count = static_cast<double>(tiles.stones().size());
    return std::sqrt(squares / count - (sum / count) * (sum / count));
  };
  EXPECT_GT(spread(uneven), 1.2 * spread(even));
}

TEST(Variation, IsSmoothWithinItsAmountAndTheSameAtEveryResolution) {
  constexpr double kAmount = 0.5;
  rocks::StoneGrid grid;
  std::vector<std::vector<int>> factors;  // at the middle of the stone's cell, by stone
  for (const int voxels_per_cell : {6, 18}) {
    const TileParams params = params_of(voxels_per_cell);
    const rocks::BlockTable blocks(params, 1, nullptr);
    rocks::Variation variation(kAmount);
    factors.emplace_back();
    for (std::uint32_t code = 0; code < 256; ++code) {
      grid.gather(blocks, {Int3(2), code, 0});
      const auto found = variation.factors(grid);
      const Int3 middle(voxels_per_cell / 2);
      for (std::size_t i = 0; i < grid.count(); ++i) {
        if (!grid.own()[i]) continue;
        ASSERT_GE(found[i], (1 - kAmount) * rocks::Variation::kOne - 1);
        ASSERT_LE(found[i], (1 + kAmount) * rocks::Variation::kOne);
        if (grid.own()[i + 1]) {
          ASSERT_NEAR(found[i], found[i + 1],
                      4.0 * kAmount * rocks::Variation::kOne / voxels_per_cell);
        }
      }
      factors.back().push_back(grid.own()[grid.index(middle)] ? found[grid.index(middle)] : 0);
    }
  }
  int compared = 0;
  for (std::size_t k = 0; k < factors[0].size(); ++k) {
    if (factors[0][k] == 0 || factors[1][k] == 0) continue;
    // Voxel centers differ by a third of a coarse voxel's diagonal.
    EXPECT_NEAR(factors[0][k], factors[1][k], 0.3 * kAmount * rocks::Variation::kOne);
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace talus
