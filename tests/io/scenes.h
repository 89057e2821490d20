// Small scenes with known answers.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <numbers>

#include "mesh/shapes.h"
#include "talus/base/hash.h"
#include "talus/mesh/instance_table.h"

namespace talus::test {

// A closed ball of 8 x 16 patches with radii that differ along the axes, so that turns show.
inline TriangleMesh pebble(const Vec3f& radii) {
  constexpr int kRings = 8, kSectors = 16;
  TriangleMesh mesh;
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s < kSectors; ++s) {
      const double polar = std::numbers::pi * r / kRings,
                   around = 2 * std::numbers::pi * s / kSectors;
      const double flat = r == 0 || r == kRings ? 0 : std::sin(polar);
      mesh.positions.push_back(
          radii * Vec3f(Vec3(flat * std::cos(around), flat * std::sin(around), std::cos(polar))));
    }
  for (std::uint32_t r = 0; r < kRings; ++r)
    for (std::uint32_t s = 0; s < kSectors; ++s) {
      const std::uint32_t a = r * kSectors + s, b = r * kSectors + (s + 1) % kSectors;
      const std::uint32_t c = a + kSectors, d = b + kSectors;
      if (r > 0) mesh.triangles.emplace_back(a, c, b);
      if (r + 1 < kRings) mesh.triangles.emplace_back(b, c, d);
    }
  compute_normals(mesh);
  return mesh;
}

inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return sum;
}

// A hilly square of 40 x 40 cells of 2 m, half of it sand; positions relative to its corner.
inline TriangleMesh hill() {
  constexpr std::uint32_t kSide = 41;
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mesh.positions.push_back(Vec3f(Vec3(2.0 * x, 2.0 * y, 3 * std::sin(0.2 * x + 0.1 * y))));
      const auto sand = static_cast<std::uint8_t>(x * 255 / (kSide - 1));
      mesh.shares.push_back({static_cast<std::uint8_t>(255 - sand), sand});
    }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      mesh.triangles.emplace_back(a, b, d);
      mesh.triangles.emplace_back(a, d, c);
    }
  compute_normals(mesh);
  return mesh;
}

// A level square of 30 m.
inline TriangleMesh pool() {
  return {.positions = {{0, 0, 1}, {30, 0, 1}, {30, 30, 1}, {0, 30, 1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

// `count` stones of three shapes around `center`, turned and scaled by chance.
inline InstanceTable heap(std::size_t count, const Vec3& center = Vec3(0)) {
  InstanceTable table;
  table.prototypes = {std::make_shared<TriangleMesh>(pebble({0.5f, 0.4f, 0.3f})),
                      std::make_shared<TriangleMesh>(unit_cube()),  // without normals
                      std::make_shared<TriangleMesh>(pebble({0.3f, 0.6f, 0.45f}))};
  for (std::size_t i = 0; i < count; ++i) {
    const auto chance = [&](int what) { return uniform(hash(1, Purpose::texture, i, what)); };
    const Vec3f axis(static_cast<float>(chance(0)) + 0.1f, static_cast<float>(chance(1)),
                     static_cast<float>(chance(2)));
    table.instances.push_back(
        {.position = center + Vec3(10 * chance(3), 20 * chance(4), 5 * chance(5)),
         .rotation = glm::angleAxis(static_cast<float>(6 * chance(6)), glm::normalize(axis)),
         .scale = static_cast<float>(0.5 + chance(7)),
         .prototype = static_cast<std::uint32_t>(3 * i / count)});
  }
  return table;
}

}  // namespace talus::test
