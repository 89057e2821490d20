// Patterns as signed distances, by the contract of `DistanceFunction`, nowhere steeper than 1.
#pragma once

#include <numbers>

#include "talus/base/elementary.h"
#include "talus/field/distance_lanes.h"
#include "talus/field/patterns.h"
#include "talus/field/support.h"

namespace talus {

// Each is asked for what of it shows in a block, then for a place of the plan: what is above one
// another has that in common.

struct Everything {};  // shows in every block

class RakedDistance {
 public:
  explicit RakedDistance(const Raked& raked);

  using Near = std::vector<Vec3>;  // rings
  const Near& everywhere() const { return raked_.rings; }
  // A ring shows to half a furrow beyond its border.
  Near near(const PointBlock& block) const {
    const Vec3 middle = block.middle();
    const double beyond = 0.51 * raked_.spacing + 1.001 * block.radius();
    Near rings;
    for (const Vec3& ring : raked_.rings)
      if (lanes::length(middle.x - ring.x, middle.y - ring.y) < ring.z + beyond)
        rings.push_back(ring);
    return rings;
  }

  template <class X>
  struct Plan {
    X beside, top;
  };
  template <class X>
  Plan<X> plan(const X& x, const X& y, const Near& rings) const {
    const X from_side = lanes::magnitude(x - raked_.center.x) - 0.5 * raked_.size.x;
    const X from_end = lanes::magnitude(y - raked_.center.y) - 0.5 * raked_.size.y;
    return {lanes::larger(from_side, from_end), raked_.ridge * height(x, y, rings)};
  }
  template <class X>
  X at(const Plan<X>& plan, const X& z) const {
    const X up = z - raked_.center.z;
    const X above = up - raked_.thickness - plan.top;
    return lanes::larger(lanes::larger(plan.beside, X(-up)), X(above * flatness_));
  }

 private:
  // Of the ridges above the furrows, from 0 to 1. Every place belongs to the ring whose border it
  // is deepest in, or to the rows; where two meet, both have run out into a furrow.
  template <class X>
  X height(const X& x, const X& y, const Near& rings) const {
    X deepest{}, second = X{} - 1e300, radius{};
    for (const Vec3& ring : rings) {
      const X r = lanes::length(X(x - ring.x), X(y - ring.y));
      const X depth = ring.z - r;
      second = depth > deepest ? deepest : lanes::larger(second, depth);
      radius = depth > deepest ? r : radius;
      deepest = lanes::larger(deepest, depth);
    }
    const X along_rows = (x - raked_.center.x) * across_.x + (y - raked_.center.y) * across_.y;
    const X phase = deepest > 0.0 ? radius / raked_.spacing : along_rows;
    const X from_border = 2.0 * (deepest - second) / raked_.spacing;
    return wave(phase) * ease(lanes::smaller(X(X{} + 1.0), from_border));
  }
  // From 0 in the furrows, at whole numbers, to 1 halfway between them; nowhere steeper than 3.
  template <class X>
  static X wave(const X& t) {
    return ease(X(1.0 - lanes::magnitude(X(2.0 * (t - lanes::floor(t)) - 1.0))));
  }
  template <class X>
  static X ease(const X& t) {
    return t * t * (3.0 - 2.0 * t);
  }

  Raked raked_;
  Vec2 across_;      // from row to row, a furrow's spacing long being 1
  double flatness_;  // distance to the surface over height above it, at least
};

struct CoursesDistance {
  Courses courses;

  static Everything everywhere() { return {}; }
  static Everything near(const PointBlock&) { return {}; }

  template <class X>
  struct Plan {};
  template <class X>
  Plan<X> plan(const X&, const X&, Everything) const {
    return {};
  }
  template <class X>
  X at(const Plan<X>&, const X& z) const {
    const Courses& c = courses;
    const X up = z - c.base - c.height * lanes::floor(X((z - c.base) / c.height));
    const double top = c.height - c.joint;
    return up > top ? lanes::smaller(X(up - top), X(c.height - up))
                    : -lanes::smaller(up, X(top - up));
  }
};

struct SpiralDistance {
  Spiral spiral;

  static Everything everywhere() { return {}; }
  static Everything near(const PointBlock&) { return {}; }

  template <class X>
  struct Plan {
    X beside;
  };
  template <class X>
  Plan<X> plan(const X& x, const X& y, Everything) const {
    const Spiral& s = spiral;
    const X dx = x - s.base.x, dy = y - s.base.y;
    const X r = lanes::length(dx, dy);
    const X turns = (lanes::larger(r, X(X{} + s.inner_radius)) - s.inner_radius) / s.pitch -
                    lanes::each(angle_of, dy, dx) / (2 * std::numbers::pi);
    const X from_wall =
        s.pitch * lanes::magnitude(X(turns - lanes::floor(X(turns + 0.5)))) - 0.5 * s.width;
    // Closer to the axis than the wall angles mean less, so that nothing changes abruptly. Divided
    // by how fast the distance along a radius can change per metre in any direction.
    const X share = lanes::smaller(X(X{} + 1.0), X(r / s.inner_radius));
    const double fastest = std::max(1.0, 0.5 * s.pitch / s.inner_radius) +
                           s.pitch / (2 * std::numbers::pi * s.inner_radius);
    return {lanes::larger(X(share * from_wall / fastest),
                          lanes::larger(X(s.inner_radius - r), X(r - s.outer_radius)))};
  }
  template <class X>
  X at(const Plan<X>& plan, const X& z) const {
    const X up = z - spiral.base.z;
    return lanes::larger(plan.beside, lanes::larger(X(-up), X(up - spiral.height)));
  }
};

Box3 bounds_of(const Raked& raked);
Box3 bounds_of(const Spiral& spiral);

// Throw `Error` (usage) for fields that do not fit together.
void check_pattern(const Raked& raked);
void check_pattern(const Courses& courses);
void check_pattern(const Spiral& spiral);

}  // namespace talus
