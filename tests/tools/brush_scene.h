// Ground on which brushes are tried.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/tools/brush.h"
#include "terrain/stacks.h"

namespace talus::test {

constexpr TerrainGrid kGrid{.nx = 90, .ny = 70, .cell = 0.5, .step = 0.001, .floor = -6000};
constexpr Vec2 kMiddle(20, 16);

// Bedrock up to 0 with a gallery from -3 m to -2 m below all of it.
inline LayeredTerrain gallery() {
  LayeredTerrain terrain(kGrid);
  terrain.edit([](int, int, ColumnEditor& column) {
    column.replace(kGrid.floor, 0, Material::bedrock);
    column.replace(-3000, -2000, Material::air);
  });
  return terrain;
}

// Random stacks as tall as a brush is wide.
inline LayeredTerrain stacks(std::uint64_t seed) { return random_stacks(seed, kGrid, 9, 1500); }

inline double draw(std::uint64_t seed, int k, double low, double high) {
  return uniform(hash(seed, Purpose::texture, 17, k), low, high);
}

// A stroke, in space for odd seeds.
inline BrushRegion random_stroke(std::uint64_t seed) {
  BrushRegion region;
  for (int i = 0; i < 3; ++i) {
    region.points.push_back({{draw(seed, 3 * i, 3, 42), draw(seed, 3 * i + 1, 3, 32)}, {}});
    if (seed % 2) region.points.back().z = draw(seed, 3 * i + 2, -6, 3);
  }
  return region;
}

inline void expect_booked(const LayeredTerrain& before, const LayeredTerrain& after,
                          const Booking& booking) {
  const MaterialSteps was = before.volume(), is = after.volume(), booked = booking.change();
  for (std::size_t m = 0; m < is.size(); ++m) EXPECT_EQ(is[m] - was[m], booked[m]);
}

inline Vec2 axis(int x, int y) { return {(x + 0.5) * kGrid.cell, (y + 0.5) * kGrid.cell}; }

inline double distance_to_stroke(const BrushRegion& region, const Vec2& p) {
  double nearest = HUGE_VAL;
  for (std::size_t i = 1; i < region.points.size(); ++i) {
    const Vec2 a = region.points[i - 1].at, b = region.points[i].at;
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(p - a - t * (b - a)));
  }
  return nearest;
}

}  // namespace talus::test
