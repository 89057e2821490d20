// Measures of outlines.
#pragma once

#include <vector>

#include "talus/base/vec.h"

namespace talus::test {

// Positive if it runs counterclockwise.
inline double area(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

}  // namespace talus::test
