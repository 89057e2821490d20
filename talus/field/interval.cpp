#include "talus/field/interval.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace talus {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kSlack = 1e-12;  // of functions that do not round monotonically

bool finite(const Interval& a) { return std::isfinite(a.lo) && std::isfinite(a.hi); }
bool has_nan(const Interval& a, const Interval& b) { return a.maybe_nan || b.maybe_nan; }

// The hull of values, of which none is lost: one that is no number says nothing.
Interval hull(std::initializer_list<double> values, bool maybe_nan) {
  Interval all{kInfinity, -kInfinity, maybe_nan};
  for (const double value : values) {
    if (std::isnan(value)) return kAnything;
    all.lo = std::min(all.lo, value);
    all.hi = std::max(all.hi, value);
  }
  return all;
}

Interval widened(const Interval& a) {
  const auto slack = [](double x) { return std::isfinite(x) ? kSlack * std::abs(x) + 1e-300 : 0; };
  return {a.lo - slack(a.lo), a.hi + slack(a.hi), a.maybe_nan};
}

// Of the values at the four corners, which are the extremes of a function that is monotone along
// either argument.
Interval over_corners(double (*f)(double, double), const Interval& a, const Interval& b) {
  if (b.lo == b.hi) return hull({f(a.lo, b.lo), f(a.hi, b.lo)}, has_nan(a, b));
  return hull({f(a.lo, b.lo), f(a.lo, b.hi), f(a.hi, b.lo), f(a.hi, b.hi)}, has_nan(a, b));
}

bool is_integer(double a) { return std::floor(a) == a; }

// Small whole powers, by repeated multiplication.
constexpr double kMultipliedUpTo = 16;
double whole_power(double a, int n) {
  double product = 1;
  for (int i = 0; i < n; ++i) product *= a;
  return product;
}

// Of an angle's cosine, given where it may lie.
Interval wave(const Interval& a, double shift, double (*f)(double)) {
  if (!(std::abs(a.lo) < 0x1p30 && std::abs(a.hi) < 0x1p30)) return {-1, 1, true};
  const auto meets = [&](double peak) {  // whether peak + 2 k pi lies within, or very nearly
    constexpr double kNear = 1e-6;
    return std::floor((a.hi - peak) / (2 * kPi) + kNear) >
           std::floor((a.lo - peak) / (2 * kPi) - kNear);
  };
  const Interval ends = hull({f(a.lo), f(a.hi)}, a.maybe_nan);
  return {meets(shift + kPi) ? -1 : std::max(-1.0, ends.lo - kSlack),
          meets(shift) ? 1 : std::min(1.0, ends.hi + kSlack), a.maybe_nan};
}

}  // namespace

double power(double a, double b) {
  if (is_integer(b) && std::abs(b) <= kMultipliedUpTo) {
    const double product = whole_power(a, static_cast<int>(std::abs(b)));
    return b < 0 ? 1 / product : product;
  }
  if (a == 0) return b > 0 ? 0 : b < 0 ? kInfinity : kNotANumber;
  if (a > 0) return exponential(b * logarithm(a));
  if (!is_integer(b)) return kNotANumber;
  const double size = exponential(b * logarithm(-a));
  return is_integer(0.5 * b) ? size : -size;
}

Interval remainder(const Interval& a, const Interval& b) {
  const double largest = std::max(std::abs(a.lo), std::abs(a.hi));
  if (!(b.lo > 0) || !(largest / b.lo < 1e12) || !finite(b)) return kAnything;
  const double slack = 1e-15 * (largest + b.hi);  // of rounding, beyond what a remainder can be
  const bool one_period = b.lo == b.hi && std::floor(a.lo / b.lo) == std::floor(a.hi / b.lo);
  if (one_period) return {remainder(a.lo, b.lo), remainder(a.hi, b.lo), has_nan(a, b)};
  return {-slack, b.hi + slack, has_nan(a, b)};
}

Interval power(const Interval& a, const Interval& b) {
  const bool whole = b.lo == b.hi && is_integer(b.lo) && std::abs(b.lo) <= kMultipliedUpTo;
  if (whole) {
    const auto n = static_cast<int>(std::abs(b.lo));
    // Even powers see sizes alone; others grow with their argument.
    const Interval base = n % 2 == 0 ? absolute(a) : a;
    const Interval product{whole_power(base.lo, n), whole_power(base.hi, n), has_nan(a, b)};
    return b.lo < 0 ? Interval{1, 1} / product : product;
  }
  if (finite(a) && finite(b) && (a.lo > 0 || (a.lo == 0 && b.lo > 0)))
    return widened(over_corners(power, a, b));
  return kAnything;
}

Interval ease(const Interval& t) { return widened({ease(t.lo), ease(t.hi), t.maybe_nan}); }

Interval sine(const Interval& a) { return wave(a, kPi / 2, sine); }
Interval cosine(const Interval& a) { return wave(a, 0, cosine); }
Interval exponential(const Interval& a) {
  return widened({exponential(a.lo), exponential(a.hi), a.maybe_nan});
}
Interval logarithm(const Interval& a) {
  if (a.hi <= 0) return kAnything;
  const Interval b{logarithm(std::max(a.lo, 0.0)), logarithm(a.hi)};
  return {b.lo - kSlack * (1 + std::abs(b.lo)), b.hi + kSlack * (1 + std::abs(b.hi)),
          a.maybe_nan || a.lo < 0};
}
Interval angle_of(const Interval& y, const Interval& x) {
  if (!finite(x) || !finite(y)) return kAnything;
  // Smooth over a box that has neither the origin nor the cut along the negative x axis.
  if (x.lo > 0 || y.lo > 0 || y.hi < 0) {
    const Interval ends = over_corners(angle_of, y, x);
    return {ends.lo - kSlack, ends.hi + kSlack, ends.maybe_nan};
  }
  return {-kPi - kSlack, kPi + kSlack, has_nan(x, y)};
}

}  // namespace talus
