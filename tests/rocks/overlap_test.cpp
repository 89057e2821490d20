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
#include <iostream>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

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
  Int3 cell;  // of the tiling
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
      if (stone.mesh) placed.push_back({cell, stone, Vec3(cell) + stone.pivot});
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
  int above_twentieth = 0;
  double most = 0;
  for (int variant = 0; variant < kVariants; ++variant) {
    TileParams params = test::varied_params(variant);
    params.n = 5;
    params.voxels_per_edge = 5 * kVoxelsPerCell;
    const std::vector<PlacedMesh> placed = place_cube(params, static_cast<std::uint64_t>(variant));
    for (int line = 0; line < kLines; ++line) {
      const auto random = [&](int k) {
        return uniform(hash(11, Purpose::texture, variant, line, k), 0, params.n - 1);
      };
      double deepest = 0;
      for (const Stretch& overlap : overlaps(placed, line % 3, random(0), random(1))) {
        // Cells lie between voxel centers.
        constexpr double kRounding = 1e-5;
        const double from = overlap.from * kVoxelsPerCell - 0.5 + kRounding;
        const double to = overlap.to * kVoxelsPerCell - 0.5 - kRounding;
        EXPECT_TRUE(from >= to || std::floor(from) == std::floor(to)) << from << " to " << to;
        deepest = std::max(deepest, to - from);
      }
      above_twentieth += deepest > 0.05;
      most = std::max(most, deepest);
    }
  }
  std::cout << above_twentieth << " of " << kVariants * kLines
            << " lines met an overlap of more than a twentieth of a voxel, at most " << most
            << '\n';
  EXPECT_LE(above_twentieth, kVariants * kLines / 1000);
}

// Where the surface of a stone crosses the segment between the centers of the two voxels at a
// contact, in voxels along its axis. Marching cubes put a vertex there.
std::optional<double> crossing_at(const PlacedMesh& mesh, const Vec3& contact, int axis,
                                  int voxels_per_cell) {
  for (const Vec3f& p : mesh.stone.mesh->positions) {
    Vec3 from = (Vec3(p) + mesh.offset - contact) * static_cast<double>(voxels_per_cell);
    const double along = std::exchange(from[axis], 0);
    if (std::abs(along) <= 0.5 && glm::length(from) < 1e-3) return along;
  }
  return std::nullopt;
}

// Even where a third stone is near.
TEST(Overlap, StonesMeetAtTheContactsThatBothKeep) {
  int contacts = 0;
  double widest = 0;  // in voxels
  for (const int variant : {0, 1, 2, 3, 5, 8}) {
    const TileParams params = test::varied_params(variant);
    const int v = params.voxels() / params.n;
    const std::vector<PlacedMesh> placed = place_cube(params, static_cast<std::uint64_t>(variant));
    std::map<std::array<int, 4>, const PlacedMesh*> by_place;
    const auto place = [](const Int3& c, int seed) { return std::array{c.x, c.y, c.z, seed}; };
    for (const PlacedMesh& m : placed) by_place[place(m.cell, m.stone.seed)] = &m;
    for (const PlacedMesh& m : placed)
      for (const StoneContact& c : m.stone.contacts) {
        const auto found = by_place.find(place(m.cell + c.cell, c.seed));
        if (found == by_place.end()) continue;
        const PlacedMesh& other = *found->second;
        const bool both_keep =
            c.kept && std::any_of(other.stone.contacts.begin(), other.stone.contacts.end(),
                                  [&](const StoneContact& o) {
                                    return o.kept && o.cell == -c.cell && o.seed == m.stone.seed;
                                  });
        if (!both_keep) continue;
        const Vec3 at = Vec3(m.cell) + Vec3(c.face) / (2.0 * v);
        const int axis = c.face.x % 2 == 0 ? 0 : c.face.y % 2 == 0 ? 1 : 2;
        const auto own = crossing_at(m, at, axis, v), its = crossing_at(other, at, axis, v);
        ASSERT_TRUE(own && its);
        widest = std::max(widest, std::abs(*own - *its));
        ++contacts;
      }
  }
  EXPECT_GT(contacts, 2000);
  EXPECT_LE(widest, 0.1112);
}

}  // namespace
}  // namespace talus
