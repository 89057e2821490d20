#include "talus/terrain/ground_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "talus/base/parallel.h"
#include "talus/mesh/check.h"
#include "talus/terrain/terrain_field.h"
#include "terrain/stacks.h"

namespace talus {
namespace {

using test::random_stacks;

constexpr TerrainGrid kGrid{
    .nx = 13, .ny = 11, .cell = 0.8, .step = 0.1, .origin_x = 500, .origin_y = -20, .floor = -7};

// Many caves, overhangs and floating pieces: layers up to two columns thick.
LayeredTerrain caves(std::uint64_t seed) { return random_stacks(seed, kGrid, 9, 16); }

const std::optional<double> kCells[] = {{}, 0.8, 0.53, 1.1, 2.9, 0.4};

Vec3 world(const GroundMesh& ground, std::uint32_t vertex) {
  return ground.origin + Vec3(ground.mesh.positions[vertex]);
}

bool same_bytes(const auto& a, const auto& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}
bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return same_bytes(a.positions, b.positions) && same_bytes(a.normals, b.normals) &&
         same_bytes(a.triangles, b.triangles) && same_bytes(a.shares, b.shares);
}

// Everything about three corners.
struct Corners {
  Vec3f positions[3];
  Vec3f normals[3];
  MaterialShares shares[3];
};

// The triangles of a mesh whose middles lie in a rectangle of the world.
std::vector<Corners> triangles_within(const GroundMesh& ground, double west, double south,
                                      double east, double north) {
  std::vector<Corners> result;
  for (const Triangle& t : ground.mesh.triangles) {
    const Vec3 middle = (world(ground, t.x) + world(ground, t.y) + world(ground, t.z)) / 3.0;
    if (middle.x < west || middle.x > east || middle.y < south || middle.y > north) continue;
    Corners corners;
    for (int c = 0; c < 3; ++c) {
      corners.positions[c] = ground.mesh.positions[t[c]];
      corners.normals[c] = ground.mesh.normals[t[c]];
      corners.shares[c] = ground.mesh.shares[t[c]];
    }
    result.push_back(corners);
  }
  return result;
}

TEST(GroundMesh, OfCavesIsManifoldOrientedAndOpenAtTheBorderOnly) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const LayeredTerrain terrain = caves(seed);
    const GroundMesh ground = make_ground_mesh(terrain, {.cell = kCells[seed % 6], .skirt = 0});
    const MeshCheck check = check_mesh(ground.mesh);
    EXPECT_TRUE(check.manifold());
    EXPECT_TRUE(check.oriented());
    EXPECT_FALSE(check.closed());
    EXPECT_EQ(check.degenerate, 0u);
    EXPECT_EQ(check.vertices, ground.mesh.positions.size());  // each is shared by index
    EXPECT_EQ(ground.ground_triangles, ground.mesh.triangles.size());

    // Edges of one triangle lie in the planes of the border.
    std::uint64_t border_edges = 0;
    Vec3f low(1e9f), high(-1e9f);
    for (const Vec3f& p : ground.mesh.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    for (const Triangle& t : ground.mesh.triangles)
      for (int c = 0; c < 3; ++c) {
        const Vec3f a = ground.mesh.positions[t[c]], b = ground.mesh.positions[t[(c + 1) % 3]];
        border_edges += (a.x == b.x && (a.x == low.x || a.x == high.x)) ||
                        (a.y == b.y && (a.y == low.y || a.y == high.y));
      }
    EXPECT_EQ(check.boundary_edges, border_edges);
    EXPECT_NEAR(ground.origin.x + low.x, kGrid.origin_x, 1e-5);
    EXPECT_NEAR(ground.origin.x + high.x, kGrid.origin_x + kGrid.nx * kGrid.cell, 1e-5);
    EXPECT_NEAR(ground.origin.y + low.y, kGrid.origin_y, 1e-5);
    EXPECT_NEAR(ground.origin.y + high.y, kGrid.origin_y + kGrid.ny * kGrid.cell, 1e-5);
  }
}

TEST(GroundMesh, WithSkirtAndBaseIsClosed) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const LayeredTerrain terrain = caves(seed);
    GroundMeshParams params{.cell = kCells[seed % 6], .skirt = 1.5};
    if (seed % 3 == 0) params.area = ColumnArea{2, 3, 9, 10};
    if (seed % 4 == 1) params.materials = {Material::rocks, Material::sand, Material::water};
    const GroundMesh solid = make_ground_mesh(terrain, params);
    const MeshCheck check = check_mesh(solid.mesh);
    EXPECT_TRUE(check.closed()) << seed;
    EXPECT_TRUE(check.manifold()) << seed;
    EXPECT_TRUE(check.oriented()) << seed;
    EXPECT_EQ(check.degenerate, 0u) << seed;
    EXPECT_GT(signed_volume(solid.mesh), 0);
    ASSERT_EQ(solid.mesh.normals.size(), solid.mesh.positions.size());
    ASSERT_EQ(solid.mesh.shares.size(), solid.mesh.positions.size());

    // Without a base what is missing is flat and lies lowest; the ground comes first, unchanged.
    params.base = false;
    const MeshCheck without_base = check_mesh(make_ground_mesh(terrain, params).mesh);
    EXPECT_TRUE(without_base.manifold());
    EXPECT_EQ(without_base.closed(), !params.materials.contains(Material::bedrock));
    params.skirt = 0;
    const GroundMesh open = make_ground_mesh(terrain, params);
    ASSERT_EQ(open.mesh.triangles.size(), solid.ground_triangles);
    ASSERT_EQ(open.mesh.positions.size(), solid.ground_vertices);
    EXPECT_EQ(std::memcmp(open.mesh.positions.data(), solid.mesh.positions.data(),
                          open.mesh.positions.size() * sizeof(Vec3f)),
              0);
    EXPECT_EQ(std::memcmp(open.mesh.triangles.data(), solid.mesh.triangles.data(),
                          open.mesh.triangles.size() * sizeof(Triangle)),
              0);
  }
}

TEST(GroundMesh, IsABlockUnlessTheSkirtIsZero) {
  LayeredTerrain terrain({.nx = 30, .ny = 20, .cell = 2, .step = 0.01});
  terrain.edit(
      [](int x, int, ColumnEditor& column) { column.replace(0, 100 + 50 * x, Material::bedrock); });
  const GroundMesh block = make_ground_mesh(terrain);
  EXPECT_TRUE(check_mesh(block.mesh).closed());
  EXPECT_NEAR(bounds(block.mesh).size().z, 14.5 + 0.05 * 60, 2) << "to a cell";
  const GroundMesh open = make_ground_mesh(terrain, {.skirt = 0});
  EXPECT_GT(check_mesh(open.mesh).boundary_edges, 0u);
  EXPECT_NEAR(bounds(open.mesh).size().z, 14.5, 0.1);
}

TEST(GroundMesh, VerticesLieOnTheFieldsSurface) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const LayeredTerrain terrain = caves(seed);
    const double cell = kCells[seed % 6].value_or(kGrid.cell);
    const GroundMesh ground = make_ground_mesh(terrain, {.cell = cell, .sigma = 0.9, .skirt = 0});
    const TerrainField field(terrain, kGroundMaterials, 0.9);
    // Vertices keep a thousandth of an edge away from its ends.
    const double bound = (cell / 800 + 1e-4) / field.sigma();
    for (std::uint32_t v = 0; v < ground.mesh.positions.size(); ++v) {
      const Vec3 p = world(ground, v);
      ASSERT_LT(std::abs(field.value(p)), bound);
      ASSERT_NEAR(glm::length(Vec3(ground.mesh.normals[v])), 1, 1e-6);
      ASSERT_EQ(std::accumulate(ground.mesh.shares[v].begin(), ground.mesh.shares[v].end(), 0),
                255);
    }
    EXPECT_GT(ground.surface_cells, 0u);
    EXPECT_GT(ground.field_samples, ground.mesh.positions.size());
  }
}

TEST(GroundMesh, NormalsPointOutOfTheGround) {
  const LayeredTerrain terrain = caves(4);
  const GroundMesh ground = make_ground_mesh(terrain, {.skirt = 0});
  double agreement = 0;
  for (const Triangle& t : ground.mesh.triangles) {
    const Vec3 a = world(ground, t.x), b = world(ground, t.y), c = world(ground, t.z);
    const Vec3 face = glm::cross(b - a, c - a);
    const Vec3 normal =
        Vec3(ground.mesh.normals[t.x] + ground.mesh.normals[t.y] + ground.mesh.normals[t.z]);
    agreement += glm::dot(face, normal) > 0;
  }
  EXPECT_GT(agreement, 0.98 * static_cast<double>(ground.mesh.triangles.size()));
}

TEST(GroundMesh, OfAnAreaIsThatPartOfTheWhole) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const LayeredTerrain terrain = caves(seed);
    GroundMeshParams params{.cell = kCells[seed], .skirt = 0};
    const GroundMesh whole = make_ground_mesh(terrain, params);
    std::size_t triangles = 0, vertices = 0;
    // Four areas that make up the terrain.
    for (const ColumnArea area : {ColumnArea{0, 0, 5, 7}, ColumnArea{5, 0, 13, 7},
                                  ColumnArea{0, 7, 5, 11}, ColumnArea{5, 7, 13, 11}}) {
      params.area = area;
      const GroundMesh part = make_ground_mesh(terrain, params);
      ASSERT_EQ(part.origin, whole.origin);
      const std::vector<Corners> of_part = triangles_within(part, -1e9, -1e9, 1e9, 1e9);
      Vec3 low(1e9), high(-1e9);
      for (std::uint32_t v = 0; v < part.mesh.positions.size(); ++v) {
        low = glm::min(low, world(part, v));
        high = glm::max(high, world(part, v));
      }
      EXPECT_TRUE(same_bytes(of_part, triangles_within(whole, low.x, low.y, high.x, high.y)));
      triangles += of_part.size();
      vertices += part.mesh.positions.size();
    }
    EXPECT_EQ(triangles, whole.mesh.triangles.size());
    EXPECT_GT(vertices, whole.mesh.positions.size());  // those between areas are in both
  }
}

TEST(GroundMesh, DoesNotDependOnThreads) {
  const LayeredTerrain terrain = caves(2);
  const GroundMeshParams params{.cell = 0.6, .skirt = 1};
  const ThreadLimit two(2);
  const GroundMesh parallel = make_ground_mesh(terrain, params);
  const ThreadLimit one(1);
  const GroundMesh serial = make_ground_mesh(terrain, params);
  EXPECT_TRUE(same(parallel.mesh, serial.mesh));
  EXPECT_EQ(parallel.deviation_mean, serial.deviation_mean);
  EXPECT_EQ(parallel.deviation_p99, serial.deviation_p99);
  EXPECT_EQ(parallel.field_samples, serial.field_samples);
}

// Columns whose middles lie on the plane through the origin with slopes (dx, dy).
LayeredTerrain plane(double dx, double dy, double cell) {
  LayeredTerrain terrain({.nx = 40, .ny = 40, .cell = cell, .step = 0.001, .floor = -100'000});
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const double height = cell * (dx * (x + 0.5) + dy * (y + 0.5));
    column.replace(-100'000, static_cast<Steps>(std::lround(height / 0.001)), Material::bedrock);
  });
  return terrain;
}

struct Unevenness {
  double distance = 0;   // farthest of vertices from the plane, in columns
  double angle_deg = 0;  // largest between their normals and the plane's
};

// Away from the border.
Unevenness unevenness(double slope_deg, double direction_deg, double cell_columns) {
  constexpr double kColumn = 0.9, kRadians = std::numbers::pi / 180;
  const double steepness = std::tan(slope_deg * kRadians);
  const double dx = steepness * std::cos(direction_deg * kRadians);
  const double dy = steepness * std::sin(direction_deg * kRadians);
  const LayeredTerrain terrain = plane(dx, dy, kColumn);
  const GroundMesh ground = make_ground_mesh(terrain, {.cell = cell_columns * kColumn, .skirt = 0});
  const Vec3 normal = glm::normalize(Vec3(-dx, -dy, 1));
  Unevenness worst;
  for (std::uint32_t v = 0; v < ground.mesh.positions.size(); ++v) {
    const Vec3 p = world(ground, v);
    if (std::min(p.x, p.y) < 5 * kColumn || std::max(p.x, p.y) > 35 * kColumn) continue;
    worst.distance = std::max(worst.distance, std::abs(glm::dot(p, normal)) / kColumn);
    const double cosine = std::min(1.0, glm::dot(normal, Vec3(ground.mesh.normals[v])));
    worst.angle_deg = std::max(worst.angle_deg, std::acos(cosine) / kRadians);
  }
  return worst;
}

// docs/terrain.md shows these numbers as a table.
TEST(GroundMesh, HidesTheStepsOfPlanes) {
  struct Bound {
    double slope_deg, distance, angle_deg;
  };
  for (const Bound& bound :
       {Bound{10, 0.001, 0.1}, Bound{20, 0.001, 0.1}, Bound{30, 0.001, 0.1}, Bound{35, 0.004, 0.1},
        Bound{40, 0.01, 0.1}, Bound{45, 0.03, 0.1}, Bound{50, 0.06, 0.1}, Bound{60, 0.07, 0.6},
        Bound{65, 0.07, 3}, Bound{70, 0.14, 9}})
    for (const double direction_deg : {0.0, 22.5, 45.0})
      for (const double cell_columns : {1.0, 0.75, 0.5}) {
        const Unevenness worst = unevenness(bound.slope_deg, direction_deg, cell_columns);
        EXPECT_LT(worst.distance, bound.distance) << bound.slope_deg << " " << direction_deg;
        EXPECT_LT(worst.angle_deg, bound.angle_deg) << bound.slope_deg << " " << direction_deg;
      }
}

TEST(GroundMesh, LevelGroundIsLevel) {
  LayeredTerrain terrain({.nx = 9, .ny = 5, .cell = 2, .step = 0.01, .floor = -300});
  terrain.edit([](int, int, ColumnEditor& column) { column.replace(-300, 123, Material::soil); });
  const GroundMesh ground = make_ground_mesh(terrain, {.skirt = 0});
  EXPECT_EQ(ground.mesh.positions.size(), 10u * 6);
  EXPECT_EQ(ground.mesh.triangles.size(), 2u * 9 * 5);
  for (std::uint32_t v = 0; v < ground.mesh.positions.size(); ++v) {
    EXPECT_NEAR(world(ground, v).z, 1.23, 1e-6);
    EXPECT_EQ(ground.mesh.normals[v], Vec3f(0, 0, 1));
    EXPECT_EQ(ground.mesh.shares[v][static_cast<std::size_t>(Material::soil)], 255);
  }
  EXPECT_NEAR(ground.deviation_max, 0, 1e-6);
}

// An air layer in the bedrock becomes a hollow, its mouth an opening.
TEST(GroundMesh, CavesAreHollow) {
  LayeredTerrain terrain({.nx = 30, .ny = 30, .cell = 1, .step = 0.01});
  terrain.edit([](int, int, ColumnEditor& column) { column.replace(0, 2000, Material::bedrock); });
  terrain.edit({10, 10, 22, 22},
               [](int, int, ColumnEditor& column) { column.replace(400, 1600, Material::air); });
  const GroundMesh hollow = make_ground_mesh(terrain, {.skirt = 3});
  EXPECT_TRUE(check_mesh(hollow.mesh).closed());
  const double height = bounds(hollow.mesh).size().z;
  EXPECT_GT(height, 16 + 3);
  // The cube over which the field averages rounds edges off.
  EXPECT_NEAR(30 * 30 * height - signed_volume(hollow.mesh), 12 * 12 * 12, 0.05 * 12 * 12 * 12);
}

TEST(GroundMesh, DeviationIsOfWhatTheMeshShows) {
  LayeredTerrain terrain({.nx = 12, .ny = 12, .cell = 1, .step = 0.01});
  terrain.edit({6, 7, 7, 8},
               [](int, int, ColumnEditor& column) { column.replace(0, 750, Material::bedrock); });
  const GroundMesh ground = make_ground_mesh(terrain);
  EXPECT_EQ(ground.columns_lost, 1u) << "a pillar thinner than the cube";
  EXPECT_LT(ground.deviation_max, 1);
}

TEST(GroundMesh, DeviationIsMeasuredAcrossCliffs) {
  constexpr double kSlope = 40;  // steeper than 88 degrees
  const GroundMesh ground = make_ground_mesh(plane(kSlope, 0, 0.5), {.cell = 0.25, .sigma = 0.5});
  EXPECT_GT(ground.deviation_max, 0);
  EXPECT_LE(ground.deviation_mean, ground.deviation_p99);
  EXPECT_LE(ground.deviation_p99, ground.deviation_max);
  EXPECT_LT(ground.deviation_p99, 0.5) << "no more than a column is wide";
}

TEST(GroundMesh, CountsTheColumnsItHasLost) {
  LayeredTerrain terrain({.nx = 24, .ny = 16, .cell = 1, .step = 0.01});
  terrain.edit({2, 3, 6, 8},  // a slab thinner than sigma
               [](int, int, ColumnEditor& column) { column.replace(300, 340, Material::rocks); });
  terrain.edit({12, 0, 24, 16},
               [](int, int, ColumnEditor& column) { column.replace(300, 1100, Material::rocks); });
  const GroundMesh rocks = make_ground_mesh(terrain, {.materials = {Material::rocks}});
  EXPECT_EQ(rocks.columns_lost, 4u * 5);
  EXPECT_LT(rocks.deviation_max, 1);
  EXPECT_EQ(make_ground_mesh(terrain).columns_lost, 0u) << "there is nothing but level ground";
}

TEST(GroundMesh, CountsWallsNoThickerThanSigmaAsLost) {
  const auto lost = [](int columns_thick, const GroundMeshParams& params) {
    LayeredTerrain terrain({.nx = 24, .ny = 16, .cell = 1, .step = 0.01});
    terrain.edit({8, 2, 8 + columns_thick, 12},
                 [](int, int, ColumnEditor& column) { column.replace(0, 900, Material::bedrock); });
    return make_ground_mesh(terrain, params).columns_lost;
  };
  EXPECT_EQ(lost(1, {}), 10u);
  EXPECT_EQ(lost(1, {.cell = 0.5, .sigma = 0.6}), 0u);
  EXPECT_EQ(lost(2, {}), 0u) << "also where edges are cut off";
  EXPECT_EQ(lost(2, {.sigma = 2.2}), 20u);
}

TEST(GroundMesh, ShowsAnySetOfMaterials) {
  LayeredTerrain terrain({.nx = 20, .ny = 20, .cell = 1, .step = 0.01});
  terrain.edit({4, 4, 16, 16},
               [](int, int, ColumnEditor& column) { column.replace(300, 1500, Material::rocks); });
  const GroundMesh rocks = make_ground_mesh(terrain, {.materials = {Material::rocks}});
  EXPECT_TRUE(check_mesh(rocks.mesh).closed());
  EXPECT_NEAR(signed_volume(rocks.mesh), 12 * 12 * 12, 0.05 * 12 * 12 * 12);
  EXPECT_TRUE(make_ground_mesh(terrain, {.materials = {Material::water}}).mesh.triangles.empty());
}

TEST(GroundMesh, RefusesWhatItCannotMesh) {
  const LayeredTerrain terrain(kGrid);
  EXPECT_THROW(make_ground_mesh(terrain, {.cell = 0.0}), Error);
  EXPECT_THROW(make_ground_mesh(terrain, {.cell = 0.001}), Error);
  EXPECT_THROW(make_ground_mesh(terrain, {.sigma = 400}), Error);
  EXPECT_THROW(make_ground_mesh(terrain, {.materials = {}}), Error);
  EXPECT_THROW(make_ground_mesh(terrain, {.materials = {Material::air}}), Error);
  EXPECT_THROW(make_ground_mesh(terrain, {.area = ColumnArea{20, 0, 30, 5}}), Error);
  Job job;
  job.cancel();
  EXPECT_THROW(make_ground_mesh(terrain, {}, &job), Cancelled);
}

}  // namespace
}  // namespace talus
