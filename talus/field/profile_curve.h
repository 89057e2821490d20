// Closed curves of the plane: the cross sections of what is swept along a path.
#pragma once

#include <span>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// The closed centripetal Catmull-Rom curve through at least three points, which need not be convex.
class ProfileCurve {
 public:
  // Throws `Error` (usage) for fewer than three points, one that is not finite or farther than 1e6
  // from the origin, neighbors that are equal, and a curve that crosses itself or encloses nothing.
  explicit ProfileCurve(std::vector<Vec2> points);

  // Counterclockwise from the first point, t from 0 to 1; each span between two points takes an
  // equal share, whatever its length.
  Vec2 at(double t) const;

  std::size_t spans() const { return points_.size(); }
  // How far from the origin the curve gets.
  double reach() const { return reach_; }

 private:
  std::vector<Vec2> points_;
  double reach_ = 0;
};

// Points of each curve at the same shares t, the same number for all: at least twelve to a span,
// and hardly more than `spacing` apart, by less than a tenth, on any of the curves. Throws `Error`
// (usage) for more than a million.
std::vector<std::vector<Vec2>> sample_alike(std::span<const ProfileCurve> curves, double spacing);

}  // namespace talus
