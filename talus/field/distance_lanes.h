// The arithmetic of distances: that of one number or of several side by side, to the same bits.
#pragma once

#include <cmath>

#include "talus/base/lanes.h"
#include "talus/base/vec.h"

namespace talus::lanes {

using std::floor, std::sqrt;
using talus::floor, talus::sqrt;

template <class X>
struct Point {
  X x, y, z;
};
template <class X>
Point<X> operator-(const Point<X>& p, const Vec3& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
template <class X>
X dot(const Point<X>& p, const Vec3& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
template <class X>
X smaller(const X& a, const X& b) {
  return b < a ? b : a;
}
template <class X>
X larger(const X& a, const X& b) {
  return a < b ? b : a;
}
template <class X>
X magnitude(const X& x) {
  return x < 0.0 ? -x : x;
}
template <class X>
X above_zero(const X& x) {
  return larger(X{}, x);
}
template <class X>
X below_zero(const X& x) {
  return smaller(x, X{});
}
// The square root is exactly rounded everywhere, which std::hypot is not.
template <class X>
X length(const X& x, const X& y) {
  return sqrt(x * x + y * y);
}
template <class X>
X length(const X& x, const X& y, const X& z) {
  return sqrt(x * x + y * y + z * z);
}
template <class X>
X each(double (*f)(double, double), const X& a, const X& b) {
  if constexpr (std::is_same_v<X, double>) {
    return f(a, b);
  } else {
    X result;
    for (std::size_t k = 0; k < kDoubleLanes; ++k) result[k] = f(a[k], b[k]);
    return result;
  }
}

}  // namespace talus::lanes
