#include "talus/tools/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "field/outlines.h"
#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/field/profile_curve.h"
#include "talus/tools/sweep_path.h"
#include "terrain/stacks.h"
#include "tools/ground.h"

namespace talus {
namespace {

constexpr TerrainGrid kGrid{.nx = 120, .ny = 100, .cell = 0.5, .step = 0.01, .floor = -3000};
const std::vector<Vec2> kRound{{2, 0}, {0, 2}, {-2, 0}, {0, -2}};

using test::ground;

LayeredTerrain block(const TerrainGrid& grid = kGrid) {
  return ground(grid, [](double, double) { return 10.0; });
}

double volume_of(Booking booking) {
  const double column = kGrid.cell * kGrid.cell * kGrid.step;
  return static_cast<double>(booking.replaced(Material::bedrock, Material::air)) * column;
}

// A path of random nodes within the terrain, below its surface.
SweepParams random_sweep(std::uint64_t seed) {
  SweepParams params{.profile = {{2, -1}, {3, 2}, {1.6, 0.5}, {0, 1.5}, {-2, 1}, {-1, -2}}};
  const int n = 3 + test::pick(seed, 0, 4);
  for (int i = 0; i < n; ++i) {
    const auto draw = [&](int k, double low, double high) {
      return uniform(hash(seed, Purpose::texture, i, k), low, high);
    };
    params.nodes.push_back({.at = {Vec2(draw(0, 8, 52), draw(1, 8, 42)), draw(2, -12, 6)},
                            .scale = draw(3, 0.7, 1.6)});
    // Any tree: each node is joined to one before.
    if (i > 0) params.arcs.push_back({test::pick(seed, i, i), i});
  }
  return params;
}

double area(const std::vector<Vec2>& profile) {
  const std::vector curves{ProfileCurve(profile)};
  return test::area(sample_alike(curves, 0.01).front());
}

// The path that a strand of nodes, all with z, makes.
std::vector<PathPoint> path_of(const SweepParams& params, const Strand& strand, double spacing) {
  std::vector<PathPoint> nodes;
  for (const std::size_t i : strand.nodes) {
    const SurfacePoint& at = params.nodes[i].at;
    nodes.push_back({.at = Vec3(at.at, *at.z), .place = static_cast<double>(nodes.size())});
  }
  return smooth_path(nodes, strand.loop, spacing);
}
std::vector<Strand> strands_of(const SweepParams& params) {
  return find_strands(params.nodes.size(), params.arcs);
}

TEST(Sweep, TakesTheIntegralOfItsProfileAlongAStraightPath) {
  const std::vector<Vec2> profiles[] = {kRound, {{1, -3}, {6, -3}, {7, 2}, {5, 3}, {5, 0}, {1, 0}}};
  for (const std::vector<Vec2>& profile : profiles)
    for (const double end_scale : {1.0, 0.5})
      for (const Vec3 to : {Vec3(50, 20, 0), Vec3(45, 40, -9), Vec3(12, 42, 3)}) {
        const Vec3 from(10, 15, -2);
        LayeredTerrain terrain = block();
        const Booking booking = sweep(
            terrain,
            {.profile = profile,
             .nodes = {{.at = {Vec2(from), from.z}}, {.at = {Vec2(to), to.z}, .scale = end_scale}}},
            1);
        // The scale changes evenly, the area with its square.
        const double mean_square = (1 + end_scale + end_scale * end_scale) / 3;
        const double expected = area(profile) * mean_square * glm::length(to - from);
        EXPECT_NEAR(volume_of(booking) / expected, 1, 0.01) << end_scale << " " << to.x;
      }
}

TEST(Sweep, ChangesOnlyWhatItsProfileReachesAndBooksIt) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SweepParams params = random_sweep(seed);
    params.fill = {.material = seed % 2 ? Material::air : Material::bedrock,
                   .roughness = seed % 3 ? 0.0 : 0.6,
                   .roughness_size = 2};
    const TerrainGrid grid{.nx = 60, .ny = 50, .cell = 1, .step = 0.5, .floor = -60};
    const LayeredTerrain before = test::random_stacks(seed, grid, 9, 20);
    LayeredTerrain terrain = before;
    const Booking booking = sweep(terrain, params, seed);
    EXPECT_EQ(test::sum(before.volume(), booking.change()), terrain.volume());
    test::expect_well_formed(terrain);
    EXPECT_FALSE(terrain == before);

    // Around the paths that the nodes' strands make.
    double reach = 0;
    for (const SweepNode& node : params.nodes)
      reach = std::max(reach, node.scale * ProfileCurve(params.profile).reach());
    std::vector<PathPoint> path;
    for (const Strand& strand : strands_of(params)) {
      const auto strand_path = path_of(params, strand, 0.2);
      path.insert(path.end(), strand_path.begin(), strand_path.end());
    }
    const double farthest = reach + params.fill.roughness + 0.3;
    for (int y = 0; y < grid.ny; ++y)
      for (int x = 0; x < grid.nx; ++x)
        for (Steps z = grid.floor; z < 60; ++z) {
          if (terrain.material(x, y, z) == before.material(x, y, z)) continue;
          const Vec3 center((x + 0.5) * grid.cell, (y + 0.5) * grid.cell, (z + 0.5) * grid.step);
          ASSERT_TRUE(std::ranges::any_of(path, [&](const PathPoint& p) {
            return glm::length(p.at - center) < farthest;
          })) << seed;
        }
  }
}

// All along every arc of random trees, joints included, the middle of a round profile is free.
TEST(Sweep, BranchesMeetWithoutGaps) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SweepParams params = random_sweep(seed);
    params.profile = kRound;
    LayeredTerrain terrain = block();
    sweep(terrain, params, 1);
    for (const Strand& strand : strands_of(params)) {
      const std::vector<PathPoint> path = path_of(params, strand, 0.1);
      // The very ends are the ends.
      for (std::size_t k = 10; k + 10 < path.size(); ++k)
        for (const Vec3 aside : {Vec3(0), Vec3(0.4, 0, 0), Vec3(0, -0.4, 0), Vec3(0, 0, 0.4)})
          ASSERT_EQ(terrain.material(path[k].at + aside), Material::air) << seed;
    }
  }
}

// A profile to the right of its path, many times wider than the path's bends: what is right of the
// nearest place on the path is gone.
TEST(Sweep, TightBendsLeaveNothingStandingBesideThem) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SweepParams params{
        .profile = {{0, -4}, {1, -5}, {39, -5}, {40, -4}, {40, 19}, {39, 20}, {1, 20}, {0, 19}}};
    if (seed % 2) params.fill = {.roughness = 1.5, .roughness_size = 4};
    const double margin = 1.5 + params.fill.roughness;
    for (int i = 0; i < 9; ++i) {
      const double y = uniform(hash(seed, Purpose::texture, i), 30, 48);
      params.nodes.push_back({.at = {Vec2(-10 + 10 * i, y), 0.0}});
      if (i > 0) params.arcs.push_back({i - 1, i});
    }
    LayeredTerrain terrain = block();
    sweep(terrain, params, seed);
    std::vector<PathPoint> path = path_of(params, strands_of(params).front(), 0.1);
    const std::vector<Vec3> along = orient_path(path, false, 1);
    int beside = 0;
    for (int y = 0; y < kGrid.ny; y += 2)
      for (int x = 0; x < kGrid.nx; x += 2) {
        const Vec3 place((x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell, 0);
        const auto nearest = std::ranges::min_element(
            path, {}, [&](const PathPoint& p) { return glm::length(p.at - place); });
        const Vec3 away = place - nearest->at;
        const Vec3& forward = along[static_cast<std::size_t>(nearest - path.begin())];
        const bool right = glm::dot(glm::cross(forward, Vec3(0, 0, 1)), away) > 0;
        // Beside the very ends a degree more or less decides.
        if (nearest - path.begin() < 20 || path.end() - nearest < 20) continue;
        if (!right || glm::length(away) < margin || glm::length(away) > 37 - margin) continue;
        ++beside;
        for (const Steps z : {0, 500, 900})
          ASSERT_EQ(terrain.material(x, y, z), Material::air) << seed << ": " << x << ", " << y;
      }
    EXPECT_GT(beside, 1000);
  }
}

TEST(Sweep, LoopsHaveNoSeam) {
  LayeredTerrain terrain = block();
  SweepParams params{.profile = kRound};
  for (const Vec2 at : {Vec2(15, 15), Vec2(45, 15), Vec2(45, 38), Vec2(15, 38)})
    params.nodes.push_back({.at = {at, 2.0}});
  params.arcs = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  sweep(terrain, params, 1);
  for (const PathPoint& p : path_of(params, strands_of(params).front(), 0.1))
    for (const double up : {-1.5, 0.0, 1.5})
      ASSERT_EQ(terrain.material(p.at + Vec3(0, 0, up)), Material::air);
}

// The cut stands on the slope's normal: as deep as the profile reaches, measured across the slope.
TEST(Sweep, ProjectedFollowsTheSurfaceAndItsNormal) {
  const auto slope = [](double x, double) { return 0.6 * (x - 30); };
  const Vec3 normal = glm::normalize(Vec3(-0.6, 0, 1));
  LayeredTerrain terrain = ground(kGrid, slope);
  SweepParams params{.profile = {{2, 3}, {-2, 3}, {-2, -4}, {2, -4}},
                     .nodes = {{.at = {Vec2(30, 5), {}}}, {.at = {Vec2(30, 45), {}}}},
                     .projected = true};
  sweep(terrain, params, 1);
  const double depth = -ProfileCurve(params.profile).at(0.625).y;  // half way along its third span
  for (const double y : {10.0, 25.0, 40.0}) {
    const Vec3 on_slope(30, y, 0);
    EXPECT_EQ(terrain.material(on_slope - (depth - 0.3) * normal), Material::air);
    EXPECT_EQ(terrain.material(on_slope - (depth + 0.3) * normal), Material::bedrock);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 across = side * glm::normalize(Vec3(1, 0, 0.6));
      EXPECT_EQ(terrain.material(on_slope - 2.0 * normal + 1.8 * across), Material::air);
      EXPECT_EQ(terrain.material(on_slope - 2.0 * normal + 3.2 * across), Material::bedrock);
    }
  }
}

TEST(Sweep, AddsBridgesOverAir) {
  const LayeredTerrain before =
      ground(kGrid, [](double x, double) { return x > 20 && x < 40 ? -20.0 : 5.0; });
  LayeredTerrain terrain = before;
  sweep(terrain,
        {.profile = {{3, 0}, {2, 1}, {-2, 1}, {-3, 0}, {0, -2}},
         .nodes = {{.at = {Vec2(16, 25), 4.0}},
                   {.at = {Vec2(30, 25), 6.0}},
                   {.at = {Vec2(44, 25), 4.0}}},
         .fill = {.material = Material::bedrock, .replaces = {Material::air}}},
        1);
  EXPECT_EQ(terrain.material(Vec3(30.1, 25.1, 6)), Material::bedrock);
  EXPECT_EQ(terrain.material(Vec3(30.1, 25.1, 0)), Material::air);
  EXPECT_EQ(terrain.material(Vec3(30.1, 30.1, 6)), Material::air);
  EXPECT_GT(terrain.volume()[0], before.volume()[0]);
}

TEST(Sweep, RoughnessStaysWithinItsReachAndFollowsTheSeed) {
  SweepParams params{.profile = kRound,
                     .nodes = {{.at = {Vec2(-9, 25), 0.0}}, {.at = {Vec2(70, 25), 0.0}}}};
  LayeredTerrain smooth = block();
  sweep(smooth, params, 1);
  params.fill = {.roughness = 0.7, .roughness_size = 2};
  LayeredTerrain rough = block(), again = block(), other = block();
  sweep(rough, params, 1);
  sweep(again, params, 1);
  sweep(other, params, 2);
  EXPECT_EQ(rough, again);
  EXPECT_FALSE(rough == other);
  int moved = 0;
  for (int y = 0; y < kGrid.ny; ++y)
    for (int x = 0; x < kGrid.nx; ++x)
      for (Steps z = -400; z < 400; z += 5) {
        const double y_off = (y + 0.5) * kGrid.cell - 25, z_off = (z + 0.5) * kGrid.step;
        const double from_axis = std::sqrt(y_off * y_off + z_off * z_off);
        const bool air = rough.material(x, y, z) == Material::air;
        moved += air != (smooth.material(x, y, z) == Material::air);
        ASSERT_TRUE(air || from_axis > 1.75 - 0.72);
        ASSERT_TRUE(!air || from_axis < 2.0 + 0.72);
      }
  EXPECT_GT(moved, 2000);
}

TEST(Sweep, AFinerGridMovesTheSurfaceByLessThanACell) {
  TerrainGrid fine = kGrid;
  fine.nx *= 2;
  fine.ny *= 2;
  fine.cell /= 2;
  const auto hills = [](double x, double y) { return std::sin(0.3 * x) + std::sin(0.4 * y); };
  for (const bool projected : {false, true}) {
    SweepParams params{
        .profile = {{4, 6}, {-4, 6}, {-3, -5}, {3, -5}},
        .nodes = {{.at = {Vec2(5, 8), {}}}, {.at = {Vec2(30, 30), {}}}, {.at = {Vec2(55, 25), {}}}},
        .projected = projected};
    LayeredTerrain coarse = ground(kGrid, hills), doubled = ground(fine, hills);
    sweep(coarse, params, 1);
    sweep(doubled, params, 1);
    // Each column's floor lies between the lowest and the highest of the finer ones around it.
    const auto top = [](const LayeredTerrain& t, int x, int y) {
      x = std::clamp(x, 0, t.grid().nx - 1);
      y = std::clamp(y, 0, t.grid().ny - 1);
      return t.height_of(t.column(x, y).back().top());
    };
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x) {
        double low = 1e9, high = -1e9;
        for (int j = -2; j < 4; ++j)
          for (int i = -2; i < 4; ++i) {
            low = std::min(low, top(doubled, 2 * x + i, 2 * y + j));
            high = std::max(high, top(doubled, 2 * x + i, 2 * y + j));
          }
        ASSERT_GT(top(coarse, x, y), low - kGrid.cell);
        ASSERT_LT(top(coarse, x, y), high + kGrid.cell);
      }
  }
}

TEST(Sweep, IsAsExactOnATerrainFarAway) {
  const Vec2 away(500'000, -300'000);
  TerrainGrid far = kGrid;
  far.origin_x = away.x;
  far.origin_y = away.y;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SweepParams params = random_sweep(seed);
    LayeredTerrain near_terrain = block(), far_terrain = block(far);
    sweep(near_terrain, params, 1);
    for (SweepNode& node : params.nodes) node.at.at += away;
    sweep(far_terrain, params, 1);
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x)
        ASSERT_TRUE(std::ranges::equal(near_terrain.column(x, y), far_terrain.column(x, y)))
            << seed << ": " << x << ", " << y;
  }
}

TEST(Sweep, IsTheSameForAnyNumberOfThreads) {
  for (const bool projected : {false, true}) {
    SweepParams params = random_sweep(5);
    params.fill = {.roughness = 0.5, .roughness_size = 3};
    params.projected = projected;
    if (projected)
      for (SweepNode& node : params.nodes) node.at.z.reset();
    LayeredTerrain terrains[] = {block(), block()};
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      sweep(terrains[threads - 1], params, 1);
    }
    EXPECT_EQ(terrains[0], terrains[1]);
    EXPECT_FALSE(terrains[0] == block());
  }
}

TEST(Sweep, RefusesWhatItCannotDoAndChangesNothing) {
  const LayeredTerrain before = block();
  LayeredTerrain terrain = before;
  const auto line = [&](const SweepParams& params) {
    try {
      sweep(terrain, params, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const SweepNode a{.at = {Vec2(10, 10), 2.0}}, b{.at = {Vec2(40, 10), 2.0}};
  SweepParams good{.profile = kRound, .nodes = {a, b}};
  const auto with = [&](auto&& change) {
    SweepParams params = good;
    change(params);
    return line(params);
  };
  EXPECT_EQ(with([](SweepParams& p) { p.nodes.pop_back(); }),
            "sweep.nodes: a path needs two nodes or more, not 1");
  // The ground is where the second node is.
  EXPECT_EQ(with([&](SweepParams& p) {
              p.nodes = {a, {.at = {Vec2(40, 10), {}}}, b};
              p.nodes[2].at.z = before.height_of(before.column(40, 10).back().top());
            }),
            "sweep.arcs: nodes 1 and 2 are at the same place, or nearly; leave one out");
  const double ground = before.height_of(before.column(10, 10).back().top());
  EXPECT_EQ(with([&](SweepParams& p) {
              p.projected = true;
              p.nodes[0].at = {Vec2(10.3, 10.3), ground};
              p.nodes[1].at = {Vec2(10.3, 10.3), ground + 0.3};
            }).substr(0, 67),
            "sweep.nodes: on the surface the path from node 0 on is too short fo");
  EXPECT_EQ(
      with([](SweepParams& p) { p.fill = {.roughness = 20, .roughness_size = 1}; }),
      "sweep.roughness = 20 m is more than 10 times sweep.roughness_size = 1 m; choose larger "
      "bumps or less of them");
  EXPECT_EQ(with([](SweepParams& p) { p.profile.resize(2); }),
            "sweep: node 0: a profile of 2 points encloses nothing; give at least 3");
  EXPECT_EQ(with([](SweepParams& p) {
              p.arcs = {{0, 1}, {1, 5}};
            }),
            "sweep.arcs: [1, 5]: there is no node 5; they count from 0 to 1");
  EXPECT_EQ(with([](SweepParams& p) {
              p.arcs = {{0, 0}};
            }),
            "sweep.arcs: [0, 0]: an arc joins two nodes");
  EXPECT_EQ(with([](SweepParams& p) {
              p.arcs = {{0, 1}, {1, 0}};
            }),
            "sweep.arcs: [1, 0]: these nodes are joined already");
  EXPECT_EQ(with([&](SweepParams& p) { p.nodes[1] = a; }),
            "sweep.arcs: [0, 1]: these nodes are at the same place");
  EXPECT_EQ(with([&](SweepParams& p) {
              p.nodes.push_back({.at = {Vec2(9, 9), 1.0}});
              p.arcs = {{0, 1}};
            }),
            "sweep.arcs: no arc joins node 2; leave it out");
  EXPECT_EQ(with([](SweepParams& p) { p.nodes[1].at.z = std::nan(""); }),
            "sweep.nodes: node 1 is no place; its coordinates must be numbers up to 1000000");
  EXPECT_NE(with([](SweepParams& p) { p.nodes[1].scale = -1; }), "nothing");
  EXPECT_NE(with([](SweepParams& p) { p.nodes[1].scale = std::nan(""); }), "nothing");
  EXPECT_NE(with([](SweepParams& p) { p.fill.roughness = -1; }), "nothing");
  EXPECT_EQ(with([](SweepParams& p) {
              for (SweepNode& node : p.nodes) node.at.at.y = 500;
            }),
            "sweep.nodes: the path is outside the terrain, which reaches from (0, 0) to (60, 50)");
  EXPECT_EQ(with([](SweepParams& p) {
              p.projected = true;
              p.nodes[1].at.z = 80;
            }),
            "sweep.nodes: no bedrock's surface within 1.25 m of (10, 10, 2), which a projected "
            "path passes");
  EXPECT_NE(with([](SweepParams& p) {
              p.nodes[1].at = {Vec2(9e5, 10), 2.0};
              p.fill.roughness = 0.1;
            }),
            "nothing");
  EXPECT_TRUE(terrain == before);
}

}  // namespace
}  // namespace talus
