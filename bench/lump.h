// A mesh of any size that is like a statue.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "talus/mesh/triangle_mesh.h"

namespace talus::bench {

// Closed: a sphere of `rings` x 2 `rings` quads, stretched and folded.
inline TriangleMesh lump(int rings) {
  constexpr double kPi = std::numbers::pi;
  TriangleMesh mesh;
  const int columns = 2 * rings;
  const auto index = [&](int r, int c) {
    if (r == 0) return 0u;
    if (r == rings) return static_cast<std::uint32_t>(1 + (rings - 1) * columns);
    return static_cast<std::uint32_t>(1 + (r - 1) * columns + c % columns);
  };
  for (int r = 0; r <= rings; ++r)
    for (int c = 0; c < (r == 0 || r == rings ? 1 : columns); ++c) {
      const double theta = kPi * r / rings, phi = 2 * kPi * c / columns;
      const double radius = 1 + 0.2 * std::sin(5 * theta) * std::cos(4 * phi) +
                            0.1 * std::sin(9 * phi) * std::sin(theta);
      mesh.positions.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                  radius * std::sin(theta) * std::sin(phi),
                                  1.6 * radius * std::cos(theta));
    }
  for (int r = 0; r < rings; ++r)
    for (int c = 0; c < columns; ++c) {
      if (r > 0) mesh.triangles.emplace_back(index(r, c), index(r + 1, c), index(r, c + 1));
      if (r + 1 < rings)
        mesh.triangles.emplace_back(index(r + 1, c), index(r + 1, c + 1), index(r, c + 1));
    }
  return mesh;
}

}  // namespace talus::bench
