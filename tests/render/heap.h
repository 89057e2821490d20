// Stones and heaps with known shapes.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "talus/base/hash.h"
#include "talus/mesh/instance_table.h"

namespace talus::test {

// Unit icosphere: 20 * 4^levels triangles, normals exact.
inline TriangleMesh sphere(int levels) {
  const float t = 0.5f * (1 + std::sqrt(5.0f));
  TriangleMesh mesh;
  mesh.positions = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                    {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  for (Vec3f& p : mesh.positions) p = glm::normalize(p);
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, fresh] = middles.try_emplace(
          {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.positions.size()));
      if (fresh) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& f : mesh.triangles) {
      const std::uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
    }
    mesh.triangles = std::move(finer);
  }
  mesh.normals = mesh.positions;
  return mesh;
}

// A rounded block about 1 wide: a ball cut by soft planes, then roughened.
inline TriangleMesh stone(std::uint64_t seed, int levels) {
  const auto random = [&](int what) {
    return uniform(hash(seed, Purpose::weathering, what), -1, 1);
  };
  TriangleMesh mesh = sphere(levels);
  for (Vec3f& p : mesh.positions) {
    double radius = 0.62;
    for (int i = 0; i < 9; ++i) {
      const Vec3 n = glm::normalize(Vec3(random(4 * i), random(4 * i + 1), random(4 * i + 2)));
      const double facing = glm::dot(Vec3(p), n);
      const double cut = 0.43 + 0.05 * random(4 * i + 3);
      if (facing > 0.05) radius = std::min(radius, cut / facing);
    }
    for (int i = 40; i < 46; ++i) {
      const Vec3 n(random(4 * i), random(4 * i + 1), random(4 * i + 2));
      radius += 0.012 * std::sin(9 * glm::dot(Vec3(p), n) + 3 * random(4 * i + 3));
    }
    p *= static_cast<float>(radius);
  }
  compute_normals(mesh);
  return mesh;
}

// Stones with a spacing of `size` wherever `contains` says so in [-1, 1]^2 x [0, 2], jittered and
// turned, sorted by their mesh.
inline InstanceTable heap(double size, int prototypes, int levels,
                          const std::function<bool(const Vec3&)>& contains) {
  InstanceTable table;
  std::vector<std::vector<Instance>> runs(static_cast<std::size_t>(prototypes));
  const int n = static_cast<int>(std::ceil(1 / size));
  for (int z = 0; z < 3 * n; ++z)
    for (int y = -n; y < n; ++y)
      for (int x = -n; x < n; ++x) {
        const auto random = [&](int what) {
          return uniform(hash(1, Purpose::seed_position, x, y, z, what));
        };
        const double shift = 0.5 * (z & 1);
        const Vec3 center = size * (Vec3(x + shift, y + shift, 0.74 * z + 0.42) +
                                    0.12 * Vec3(random(0), random(1), 0));
        if (!contains(center)) continue;
        const auto prototype = static_cast<std::uint32_t>(random(3) * prototypes);
        const auto turn = [&](int what) { return static_cast<float>(2 * random(what) - 1); };
        runs[prototype].push_back(
            {.position = center,
             .rotation = glm::normalize(Quat(turn(4), turn(5), turn(6), turn(7))),
             .scale = static_cast<float>(size * (0.98 + 0.2 * random(8))),
             .prototype = prototype});
      }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].empty()) continue;
    for (Instance& instance : runs[i]) {
      instance.prototype = static_cast<std::uint32_t>(table.prototypes.size());
      table.instances.push_back(instance);
    }
    table.prototypes.push_back(std::make_shared<TriangleMesh>(stone(i, levels)));
  }
  return table;
}

}  // namespace talus::test
