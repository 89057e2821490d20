// A cube root with the same bits from every compiler and library, which std::cbrt has not.
#pragma once

#include <algorithm>

namespace talus {

// Of a positive number, by Newton's method from above.
inline double cube_root(double a) {
  double x = std::max(a, 1.0);
  for (double next = x; (next = (2 * x + a / (x * x)) / 3) < x;) x = next;
  return x;
}

}  // namespace talus
