#include <fmt/format.h>

#include <cmath>

#include "talus/base/angle.h"
#include "talus/base/error.h"
#include "talus/field/pattern_distance.h"

namespace talus {
RakedDistance::RakedDistance(const Raked& raked)
    : raked_(raked),
      across_(Vec2(-sin_deg(raked.direction_deg), cos_deg(raked.direction_deg)) / raked.spacing) {
  // Ridges are at most as steep as their wave and the way they end, together.
  const double steepest = 9 * raked.ridge / raked.spacing;
  flatness_ = 1 / std::sqrt(1 + steepest * steepest);
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
