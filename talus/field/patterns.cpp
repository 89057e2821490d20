#include "talus/field/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "talus/base/angle.h"
#include "talus/base/elementary.h"
#include "talus/base/error.h"

namespace talus {
namespace {

constexpr double kPi = std::numbers::pi;

double ease(double t) { return t * t * (3 - 2 * t); }

// From 0 in the furrows, at whole numbers, to 1 halfway between them; nowhere steeper than 3.
double wave(double t) { return ease(1 - std::abs(2 * (t - std::floor(t)) - 1)); }

double radius_of(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

RakedDistance::RakedDistance(const Raked& raked)
    : raked_(raked),
      across_(Vec2(-sin_deg(raked.direction_deg), cos_deg(raked.direction_deg)) / raked.spacing) {
  // Ridges are at most as steep as their wave and the way they end, together.
  const double steepest = 9 * raked.ridge / raked.spacing;
  flatness_ = 1 / std::sqrt(1 + steepest * steepest);
}

// Of the ridges above the furrows, from 0 to 1. Every place belongs to the ring whose border it is
// deepest in, or to the rows; where two meet, both have run out into a furrow.
double RakedDistance::height_at(const Vec2& p) const {
  double deepest = 0, second = -1e300;
  double phase = glm::dot(p - Vec2(raked_.center), across_);
  for (const Vec3& ring : raked_.rings) {
    const double r = radius_of(p.x - ring.x, p.y - ring.y);
    const double depth = ring.z - r;
    if (depth > deepest) {
      second = deepest;
      deepest = depth;
      phase = r / raked_.spacing;
    } else {
      second = std::max(second, depth);
    }
  }
  return wave(phase) * ease(std::min(1.0, 2 * (deepest - second) / raked_.spacing));
}

double RakedDistance::operator()(const Vec3& p) const {
  const Vec3 q = p - raked_.center;
  const double beside =
      std::max(std::abs(q.x) - 0.5 * raked_.size.x, std::abs(q.y) - 0.5 * raked_.size.y);
  const double above = q.z - raked_.thickness - raked_.ridge * height_at(Vec2(p));
  return std::max({beside, -q.z, above * flatness_});
}

double CoursesDistance::operator()(const Vec3& p) const {
  const Courses& c = courses;
  const double up = (p.z - c.base) - c.height * std::floor((p.z - c.base) / c.height);
  const double top = c.height - c.joint;
  return up > top ? std::min(up - top, c.height - up) : -std::min(up, top - up);
}

double SpiralDistance::operator()(const Vec3& p) const {
  const Spiral& s = spiral;
  const Vec3 q = p - s.base;
  const double r = radius_of(q.x, q.y);
  const double turns =
      (std::max(r, s.inner_radius) - s.inner_radius) / s.pitch - angle_of(q.y, q.x) / (2 * kPi);
  const double from_wall = s.pitch * std::abs(turns - std::floor(turns + 0.5)) - 0.5 * s.width;
  // Closer to the axis than the wall angles mean less, so that nothing changes abruptly. Divided by
  // how fast the distance along a radius can change per metre in any direction.
  const double share = std::min(1.0, r / s.inner_radius);
  const double fastest =
      std::max(1.0, 0.5 * s.pitch / s.inner_radius) + s.pitch / (2 * kPi * s.inner_radius);
  return std::max(
      {share * from_wall / fastest, s.inner_radius - r, r - s.outer_radius, -q.z, q.z - s.height});
}

Box3 bounds_of(const Raked& r) {
  const Vec3 half(0.5 * r.size, 0);
  return {r.center - half, r.center + half + Vec3(0, 0, r.thickness + r.ridge)};
}
Box3 bounds_of(const Spiral& s) {
  const Vec3 half(s.outer_radius, s.outer_radius, 0);
  return {s.base - half, s.base + half + Vec3(0, 0, s.height)};
}

void check_pattern(const Raked& raked) {
  for (const Vec3& ring : raked.rings)
    if (!(ring.z >= 0))
      throw usage_error(
          fmt::format("support.raked.rings: a radius of {} m; it must be at least 0 m", ring.z));
}
void check_pattern(const Courses& c) {
  if (!(c.joint < c.height))
    throw usage_error(
        fmt::format("support.courses.joint = {} m leaves nothing of layers of {} m; "
                    "it must be less",
                    c.joint, c.height));
}
void check_pattern(const Spiral& s) {
  if (!(s.outer_radius >= s.inner_radius))
    throw usage_error(
        fmt::format("support.spiral.outer_radius = {} m is too small; it must be at "
                    "least inner_radius, {} m",
                    s.outer_radius, s.inner_radius));
  if (!(s.width < s.pitch))
    throw usage_error(
        fmt::format("support.spiral.width = {} m fills all between the turns; it must "
                    "be less than pitch, {} m",
                    s.width, s.pitch));
}

}  // namespace talus
