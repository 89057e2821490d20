// Meshes with a known inside.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "talus/mesh/triangle_mesh.h"

namespace talus::test {

// Icosahedron split `levels` times, on the unit sphere, closed and outward.
inline TriangleMesh icosphere(int levels) {
  const float a = 0.525731112f, b = 0.850650808f;
  TriangleMesh m;
  m.positions = {{-a, 0, b}, {a, 0, b},   {-a, 0, -b}, {a, 0, -b}, {0, b, a},  {0, b, -a},
                 {0, -b, a}, {0, -b, -a}, {b, a, 0},   {-b, a, 0}, {b, -a, 0}, {-b, -a, 0}};
  m.triangles = {{0, 1, 4}, {0, 4, 9},  {9, 4, 5},  {4, 8, 5},  {4, 1, 8},  {8, 1, 10}, {8, 10, 3},
                 {5, 8, 3}, {5, 3, 2},  {2, 3, 7},  {7, 3, 10}, {7, 10, 6}, {7, 6, 11}, {11, 6, 0},
                 {0, 6, 1}, {6, 10, 1}, {9, 11, 0}, {9, 2, 11}, {9, 5, 2},  {7, 11, 2}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(m.positions.size()));
      if (is_new) m.positions.push_back(glm::normalize(m.positions[i] + m.positions[j]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : m.triangles) {
      const std::uint32_t x = middle(t.x, t.y), y = middle(t.y, t.z), z = middle(t.z, t.x);
      finer.insert(finer.end(), {{t.x, x, z}, {t.y, y, x}, {t.z, z, y}, {x, y, z}});
    }
    m.triangles = std::move(finer);
  }
  return m;
}

inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b, const Vec3f& offset) {
  TriangleMesh m = a;
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  for (const Vec3f& p : b.positions) m.positions.push_back(p + offset);
  for (const Triangle& t : b.triangles) m.triangles.push_back(t + first);
  return m;
}

}  // namespace talus::test
