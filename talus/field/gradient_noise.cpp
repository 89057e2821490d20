#include "talus/field/gradient_noise.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace talus {
namespace {

// The noise in space reaches a little beyond 1.
constexpr double kWithinOne = 0.96;

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mix(double a, double b, double t) { return a + t * (b - a); }

// Directions of the planes through zero at lattice points, by chance one of eight; scaled so that
// the noise reaches 1 between four points that agree.
constexpr double kLong = 1.4142135623730951;
constexpr std::array<Vec2, 8> kDirections = {Vec2(kLong, 0),  Vec2(-kLong, 0), Vec2(0, kLong),
                                             Vec2(0, -kLong), Vec2(1, 1),      Vec2(1, -1),
                                             Vec2(-1, 1),     Vec2(-1, -1)};

// Height of a lattice point's plane at (dx, dy) from it.
double slope(std::uint64_t random, double dx, double dy) {
  const Vec2& direction = kDirections[random & 7];
  return direction.x * dx + direction.y * dy;
}

// The same in space: the edge directions of a cube, four of them twice ([Perlin2002]).
constexpr std::array<Vec3, 16> kEdges = {
    Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(1, -1, 0), Vec3(-1, -1, 0),
    Vec3(1, 0, 1), Vec3(-1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1),
    Vec3(0, 1, 1), Vec3(0, -1, 1), Vec3(0, 1, -1), Vec3(0, -1, -1),
    Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(0, -1, 1), Vec3(0, -1, -1)};

double slope(std::uint64_t random, const Vec3& d) { return glm::dot(kEdges[random & 15], d); }

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
  const Vec2 corner = glm::floor(p);
  const Vec2 f = p - corner;
  const auto ix = static_cast<std::int64_t>(corner.x), iy = static_cast<std::int64_t>(corner.y);
  const auto along_y = [&](int dx) {
    const std::uint64_t h = extend(root_, ix + dx);
    return mix(slope(extend(h, iy), f.x - dx, f.y), slope(extend(h, iy + 1), f.x - dx, f.y - 1),
               fade(f.y));
  };
  return mix(along_y(0), along_y(1), fade(f.x));
}

Vec3 GradientNoise::at(const Vec3& p) const {
  const Vec3 corner = glm::floor(p);
  const Vec3 f = p - corner;
  const auto ix = static_cast<std::int64_t>(corner.x), iy = static_cast<std::int64_t>(corner.y),
             iz = static_cast<std::int64_t>(corner.z);
  const auto at_point = [&](std::uint64_t h, const Vec3& d) {
    return Vec3(slope(h, d), slope(h >> 8, d), slope(h >> 16, d));
  };
  const auto along_z = [&](std::uint64_t h, int dx, int dy) {
    const Vec3 d = f - Vec3(dx, dy, 0);
    return glm::mix(at_point(extend(h, iz), d), at_point(extend(h, iz + 1), d - Vec3(0, 0, 1)),
                    fade(f.z));
  };
  const auto along_y = [&](int dx) {
    const std::uint64_t h = extend(root_, ix + dx);
    return glm::mix(along_z(extend(h, iy), dx, 0), along_z(extend(h, iy + 1), dx, 1), fade(f.y));
  };
  return kWithinOne * glm::mix(along_y(0), along_y(1), fade(f.x));
}

double fractal(const GradientNoise& noise, Vec2 p, const FractalParams& params) {
  return sum_octaves<Vec2, double>(noise, p, params);
}

Vec3 fractal(const GradientNoise& noise, Vec3 p, const FractalParams& params) {
  return sum_octaves<Vec3, Vec3>(noise, p, params);
}

}  // namespace talus
