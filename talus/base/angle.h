// Angles, with the same bits on every machine, which the C library's functions do not promise.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>

#include "talus/base/vec.h"

namespace talus {

// Exact for multiples of 90 degrees, else within 1e-15 for angles up to a few turns.
inline double sin_deg(double degrees) {
  // Folded into [-90, 90] by the sine's symmetries.
  double d = degrees - 360 * std::floor(degrees / 360 + 0.5);
  if (d > 90) d = 180 - d;
  if (d < -90) d = -180 - d;

  // Nested Taylor series: the sine's near 0, the cosine's near 90 degrees.
  constexpr double kRadians = 0.017453292519943295;
  const bool steep = std::abs(d) > 45;
  const double x = kRadians * (steep ? 90 - std::abs(d) : std::abs(d));
  double sum = 1;
  for (int k = steep ? 18 : 19; k > 1; k -= 2) sum = 1 - x * x / (k * (k - 1)) * sum;
  return std::copysign(steep ? sum : x * sum, d);
}
inline double cos_deg(double degrees) { return sin_deg(degrees + 90); }
inline double tan_deg(double degrees) { return sin_deg(degrees) / cos_deg(degrees); }

// Turns about the x axis, then y, then z, each counter-clockwise seen from its positive end.
inline glm::dmat3 rotation_deg(const Vec3& degrees) {
  glm::dmat3 rotation(1);
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    glm::dmat3 turn(1);
    turn[a][a] = turn[b][b] = cos_deg(degrees[axis]);
    turn[a][b] = sin_deg(degrees[axis]);
    turn[b][a] = -turn[a][b];
    rotation = turn * rotation;
  }
  return rotation;
}

}  // namespace talus
