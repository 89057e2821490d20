// Smooth curves through points.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

namespace talus {

// The point at a share t of the way from p1 to p2 along the centripetal Catmull-Rom curve through
// four points, a cubic without loops and cusps between p1 and p2 ([Yuksel2011]). Neighboring points
// must differ.
template <class V>
V catmull_rom(const V& p0, const V& p1, const V& p2, const V& p3, double t) {
  const auto knots = [](const V& a, const V& b) { return std::sqrt(glm::length(b - a)); };
  const double k1 = knots(p0, p1), k2 = k1 + knots(p1, p2), k3 = k2 + knots(p2, p3);
  const double k = k1 + t * (k2 - k1);
  const auto between = [k](const V& a, double ka, const V& b, double kb) {
    return ((kb - k) * a + (k - ka) * b) / (kb - ka);
  };
  const V a1 = between(p0, 0, p1, k1), a2 = between(p1, k1, p2, k2), a3 = between(p2, k2, p3, k3);
  return between(between(a1, 0, a2, k2), k1, between(a2, k1, a3, k3), k2);
}

}  // namespace talus
