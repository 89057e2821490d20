// Meshes of neighboring stones touch; they hardly go into each other.
//
// Fields of two stones never sum above zero at a voxel center. Triangles keep that on every face of
// a marching cell: along its edges the crossings are in order, and segments that cut off corners
// in order do not meet. So the solids can only overlap in the interior of a cell, by less than a
// voxel, where polygons with four and more corners bend differently.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "rocks/tiling.h"
#include "talus/rocks/stone_maker.h"

namespace talus {
namespace {

using test::for_each_cell;

struct Crossing {
  double at;
  int step;  // + 1 into the stone, - 1 out of it
};

// Where the line through (u, v) along `axis` crosses a mesh moved by `offset`.
void cross(const TriangleMesh& mesh, const Vec3& offset, int axis, double u, double v,
           std::vector<Crossing>& out) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = Vec3(mesh.positions[t[static_cast<int>(k)]]) + offset;
    const auto edge = [&](std::size_t i, std::size_t j) {
      return (p[i][a] - u) * (p[j][b] - v) - (p[j][a] - u) * (p[i][b] - v);
    };
    const double w0 = edge(1, 2), w1 = edge(2, 0), w2 = edge(0, 1), area = w0 + w1 + w2;
    if (area == 0 || (w0 >= 0) != (area > 0) || (w1 >= 0) != (area > 0) || (w2 >= 0) != (area > 0))
      continue;
    const double at = (w0 * p[0][axis] + w1 * p[1][axis] + w2 * p[2][axis]) / area;
    out.push_back({at, area < 0 ? 1 : -1});
  }
}

struct PlacedMesh {
  Stone stone;
  Vec3 offset;
};

std::vector<PlacedMesh> place_cube(const TileParams& params, std::uint64_t seed) {
  const rocks::BlockTable blocks(params, seed, nullptr);
  const test::Tiling tiling(params, seed);
  rocks::StoneMaker maker(params, blocks);
  std::vector<PlacedMesh> placed;
  for_each_cell(Int3(-1), Int3(blocks.layout().period() + 1), [&](const Int3& cell) {
    const std::size_t seeds = tiling.seeds(blocks.seeds(), cell).size();
    for (std::uint16_t k = 0; k < seeds; ++k) {
      const Stone stone = maker.make(tiling.key(cell, k)).stone;
      if (stone.mesh) placed.push_back({stone, Vec3(cell) + stone.pivot});
    }
  });
  return placed;
}

struct Stretch {
  double from, to;
};

// The stretches of a line that lie in two stones or more.
std::vector<Stretch> overlaps(const std::vector<PlacedMesh>& placed, int axis, double u, double v) {
  std::vector<Crossing> crossings;
  for (const PlacedMesh& mesh : placed) {
    const Vec3 to_line(mesh.offset[(axis + 1) % 3] - u, mesh.offset[(axis + 2) % 3] - v, 0);
    if (glm::length(to_line) <= mesh.stone.radius)
      cross(*mesh.stone.mesh, mesh.offset, axis, u, v, crossings);
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.at, a.step) < std::tie(b.at, b.step);
  });
  std::vector<Stretch> stretches;
  int depth = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    depth += crossings[i].step;
    EXPECT_GE(depth, 0);
    if (depth > 1 && i + 1 < crossings.size())
      stretches.push_back({crossings[i].at, crossings[i + 1].at});
  }
  EXPECT_EQ(depth, 0);
  return stretches;
}

TEST(Overlap, StaysInsideOneMarchingCell) {
  constexpr int kVariants = 40, kLines = 300, kVoxelsPerCell = 6;
  int above_quarter = 0;
  for (int variant = 0; variant < kVariants; ++variant) {
    TileParams params = test::varied_params(variant);
    params.n = 5;
    params.voxels_per_edge = 5 * kVoxelsPerCell;
    const std::vector<PlacedMesh> placed = place_cube(params, static_cast<std::uint64_t>(variant));
    for (int line = 0; line < kLines; ++line) {
      const auto random = [&](int k) {
        return uniform(hash(11, Purpose::texture, variant, line, k), 0, params.n - 1);
      };
      for (const Stretch& overlap : overlaps(placed, line % 3, random(0), random(1))) {
        // Cells lie between voxel centers.
        constexpr double kRounding = 1e-5;
        const double from = overlap.from * kVoxelsPerCell - 0.5 + kRounding;
        const double to = overlap.to * kVoxelsPerCell - 0.5 - kRounding;
        EXPECT_TRUE(from >= to || std::floor(from) == std::floor(to)) << from << " to " << to;
        above_quarter += to - from > 0.25;
      }
    }
  }
  EXPECT_LE(above_quarter, kVariants * kLines / 1000);
}

}  // namespace
}  // namespace talus
