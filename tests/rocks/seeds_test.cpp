// Where seeds lie and how stones are turned.
#include "talus/rocks/seeds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "rocks/tiling.h"
#include "talus/base/angle.h"
#include "talus/rocks/block_statistics.h"
#include "talus/rocks/seed_places.h"

namespace talus {
namespace {

using namespace rocks;

constexpr Variety kVarieties[] = {Variety::aperiodic, Variety::columns, Variety::periodic};

TileParams with_placement(SeedPlacement placement, Variety variety, int n = 5) {
  return {.variety = variety, .n = n, .voxels_per_edge = 4 * n, .placement = placement};
}

double spacing(const TileParams& params, std::uint64_t seed) {
  return least_seed_spacing(BlockTable(params, seed, nullptr));
}

// The distance from each seed of a piece of a tiling to the nearest other.
std::vector<double> nearest_distances(const TileParams& params, std::uint64_t seed) {
  const SeedTable table(params, seed);
  const test::Tiling tiling(params, seed);
  const int voxels = table.layout().voxels_per_cell;
  std::vector<Vec3> points;
  test::for_each_cell(Int3(-1), Int3(9), [&](const Int3& cell) {
    for (const Seed& s : tiling.seeds(table, cell))
      points.push_back(Vec3(cell) + Vec3(s.position) / double(voxels));
  });
  std::vector<double> nearest;
  for (const Vec3& a : points) {
    if (std::min({a.x, a.y, a.z}) < 0 || std::max({a.x, a.y, a.z}) > 8) continue;
    double least = 10;
    for (const Vec3& b : points)
      if (&a != &b) least = std::min(least, glm::distance(a, b));
    nearest.push_back(least);
  }
  return nearest;
}

TEST(Seeds, EveryCellHasAsManyAsAskedFor) {
  for (const Variety variety : kVarieties)
    for (const SeedPlacement placement : {SeedPlacement::low_discrepancy, SeedPlacement::poisson}) {
      TileParams params = with_placement(placement, variety);
      params.seeds_min = 2;
      params.seeds_max = 5;
      const auto places = place_seeds(params, 3);
      std::size_t total = 0;
      for (const auto& of_cell : places) {
        total += of_cell.size();
        for (const Vec3& p : of_cell)
          for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(p[axis] >= 0 && p[axis] < 1);
        if (variety == Variety::periodic && placement == SeedPlacement::poisson) continue;
        ASSERT_GE(of_cell.size(), 2u);
        ASSERT_LE(of_cell.size(), 5u);
      }
      params.placement = SeedPlacement::low_discrepancy;
      std::size_t wanted = 0;
      for (const auto& of_cell : place_seeds(params, 3)) wanted += of_cell.size();
      EXPECT_EQ(total, wanted);
    }
}

TEST(Seeds, SpacingIsThatOfTheNearestPair) {
  for (const Variety variety : kVarieties)
    for (const SeedPlacement placement : {SeedPlacement::low_discrepancy, SeedPlacement::poisson}) {
      const TileParams params = with_placement(placement, variety);
      const std::vector<double> nearest = nearest_distances(params, 4);
      const double least = *std::min_element(nearest.begin(), nearest.end());
      const double told = spacing(params, 4);
      EXPECT_LE(told, least + 1e-5);
      // A piece of two cubes along each edge holds all pairs of a periodic set.
      if (variety == Variety::periodic) {
        EXPECT_NEAR(told, least, 1e-5);
      }
    }
}

// Balls thrown at random until no further one fits keep 0.90 edges of a cell apart at one to a
// cell; placement that must make do with a given number of them comes close.
TEST(Seeds, PoissonInAPeriodicCubeIsNearlySaturated) {
  for (const int n : {5, 7, 9})
    for (const std::uint64_t seed : {1u, 2u, 3u})
      EXPECT_GT(spacing(with_placement(SeedPlacement::poisson, Variety::periodic, n), seed), 0.75)
          << n << " " << seed;
}

TEST(Seeds, PoissonKeepsSeedsApart) {
  const auto mean = [](const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x;
    return sum / static_cast<double>(v.size());
  };
  for (const Variety variety : kVarieties) {
    const auto even = nearest_distances(with_placement(SeedPlacement::low_discrepancy, variety), 5);
    const auto apart = nearest_distances(with_placement(SeedPlacement::poisson, variety), 5);
    EXPECT_GT(mean(apart), 1.15 * mean(even));
  }
}

// The axis along which a seed's quadratic form is largest: that of a slab's thickness.
Vec3 thin_axis(const Seed& s) {
  Vec3 v(0.3, 0.5, 0.8);
  for (int i = 0; i < 200; ++i)
    v = glm::normalize(Vec3(s.xx * v.x + 0.5 * (s.xy * v.y + s.xz * v.z),
                            s.yy * v.y + 0.5 * (s.xy * v.x + s.yz * v.z),
                            s.zz * v.z + 0.5 * (s.xz * v.x + s.yz * v.y)));
  return v;
}

TEST(Seeds, BeddedSlabsLieWithinTheSpread) {
  for (const double spread : {0.0, 10.0, 40.0, 90.0})
    for (const Vec3 bedding : {Vec3(0, 0, 1), Vec3(-3, 1, 2)}) {
      TileParams params = with_placement(SeedPlacement::low_discrepancy, Variety::periodic, 9);
      params.axis_z = {0.2, 0.2};
      params.frames = Frames::bedded;
      params.bedding = bedding;
      params.bedding_spread_deg = spread;
      const SeedTable table(params, 1);
      double least = 1, sum = 0;
      for (std::size_t c = 0; c < table.layout().cell_count(); ++c) {
        const Seed& seed = table.seeds(table.layout().cell_at(c), 0)[0];
        const double cosine = std::abs(glm::dot(thin_axis(seed), glm::normalize(bedding)));
        least = std::min(least, cosine);
        sum += cosine;
      }
      const double limit = cos_deg(spread);
      EXPECT_GE(least, limit - 1e-5);
      // Uniform on the cap: the cosine is uniform, too.
      const double mean = sum / static_cast<double>(table.layout().cell_count());
      EXPECT_NEAR(mean, 0.5 * (1 + limit), 0.05 * (1 - limit) + 1e-5);
    }
}

}  // namespace
}  // namespace talus
