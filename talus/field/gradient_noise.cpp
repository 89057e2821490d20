#include "talus/field/gradient_noise.h"

#include <cmath>
#include <glm/common.hpp>

#include "talus/base/hash.h"

namespace talus {
namespace {

// The noise in space reaches a little beyond 1.
constexpr double kWithinOne = 0.96;

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mix(double a, double b, double t) { return a + t * (b - a); }

// The plane through zero at a lattice point in one of eight directions, at (dx, dy) from it;
// scaled so that the noise reaches 1 between four points that agree.
double slope(std::uint64_t random, double dx, double dy) {
  constexpr double kLong = 1.4142135623730951;
  switch (random & 7) {
    case 0:
      return kLong * dx;
    case 1:
      return -kLong * dx;
    case 2:
      return kLong * dy;
    case 3:
      return -kLong * dy;
    case 4:
      return dx + dy;
    case 5:
      return dx - dy;
    case 6:
      return dy - dx;
    default:
      return -dx - dy;
  }
}

// The same in space: one of the twelve edge directions of a cube ([Perlin2002]).
double slope(std::uint64_t random, const Vec3& d) {
  const unsigned edge = static_cast<unsigned>(random & 0xff) % 12;
  const int axis = static_cast<int>(edge >> 2);
  const double a = d[(axis + 1) % 3], b = d[(axis + 2) % 3];
  return ((edge & 1) != 0 ? -a : a) + ((edge & 2) != 0 ? -b : b);
}

double ridge(double n, double ridged) { return mix(n, 1 - 2 * std::abs(n), ridged); }
Vec3 ridge(const Vec3& n, double ridged) { return glm::mix(n, 1.0 - 2.0 * glm::abs(n), ridged); }

template <class P, class V>
V sum_octaves(const GradientNoise& noise, P p, const FractalParams& params) {
  V sum(0);
  double strength = 1, total = 0;
  for (int octave = 0; octave < params.octaves; ++octave) {
    sum += strength * ridge(noise.at(p), params.ridged);
    total += strength;
    strength *= params.gain;
    // Shifted as well, so that no lattice point is common to all octaves.
    p = p * params.lacunarity + P(17.13);
  }
  return sum / total;
}

}  // namespace

double GradientNoise::at(const Vec2& p) const {
  const Vec2 corner(std::floor(p.x), std::floor(p.y));
  const double fx = p.x - corner.x, fy = p.y - corner.y;
  const auto ix = static_cast<std::int64_t>(corner.x), iy = static_cast<std::int64_t>(corner.y);
  const auto at_corner = [&](int dx, int dy) {
    return slope(hash(seed_, Purpose::gradient_noise, ix + dx, iy + dy), fx - dx, fy - dy);
  };
  const double u = fade(fx);
  return mix(mix(at_corner(0, 0), at_corner(1, 0), u), mix(at_corner(0, 1), at_corner(1, 1), u),
             fade(fy));
}

Vec3 GradientNoise::at(const Vec3& p) const {
  const Vec3 corner = glm::floor(p);
  const Vec3 f = p - corner;
  const auto ix = static_cast<std::int64_t>(corner.x), iy = static_cast<std::int64_t>(corner.y),
             iz = static_cast<std::int64_t>(corner.z);
  const Vec3 t(fade(f.x), fade(f.y), fade(f.z));
  Vec3 sum(0);
  for (int k = 0; k < 8; ++k) {
    const int dx = k & 1, dy = k >> 1 & 1, dz = k >> 2;
    const double weight = (dx ? t.x : 1 - t.x) * (dy ? t.y : 1 - t.y) * (dz ? t.z : 1 - t.z);
    const std::uint64_t random = hash(seed_, Purpose::gradient_noise, ix + dx, iy + dy, iz + dz);
    const Vec3 d = f - Vec3(dx, dy, dz);
    sum += weight * Vec3(slope(random, d), slope(random >> 8, d), slope(random >> 16, d));
  }
  return kWithinOne * sum;
}

double fractal(const GradientNoise& noise, Vec2 p, const FractalParams& params) {
  return sum_octaves<Vec2, double>(noise, p, params);
}

Vec3 fractal(const GradientNoise& noise, Vec3 p, const FractalParams& params) {
  return sum_octaves<Vec3, Vec3>(noise, p, params);
}

}  // namespace talus
