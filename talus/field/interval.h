// Interval arithmetic: what a function may be anywhere in a box; and the functions themselves, all
// of them for one number or for several side by side, to the same bits.
#pragma once

#include <limits>

#include "talus/base/elementary.h"
#include "talus/field/distance_lanes.h"

namespace talus {

template <class X>
using MaskOf = decltype(X{} < X{});

// Every value of a computation is in [lo, hi], or is not a number if `maybe_nan`. Functions of
// intervals hold for the functions of numbers to the last bit, rounding included: the basic ones
// round monotonically, the others are widened by more than their error.
template <class X>
struct Bounds {
  X lo, hi;
  MaskOf<X> maybe_nan;
};
using Interval = Bounds<double>;
using Intervals = Bounds<Doubles>;

// What no bound is known of.
inline constexpr Interval kAnything{-std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity(), true};

namespace detail {

template <class M>
M either(const M& a, const M& b) {
  return static_cast<M>(a | b);
}
template <class X>
MaskOf<X> is_nan(const X& x) {
  return x != x;
}
// Of infinities the difference is no number.
template <class X>
MaskOf<X> infinite(const Bounds<X>& a, const Bounds<X>& b) {
  return (a.lo - a.lo) + (a.hi - a.hi) + (b.lo - b.lo) + (b.hi - b.hi) != 0.0;
}
// Bounds that a number which is none has no say in, for nothing is known then.
template <class X>
Bounds<X> bounded(const X& lo, const X& hi, const MaskOf<X>& lost, const MaskOf<X>& maybe_nan) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {lost ? X{} - kInfinity : lo, lost ? X{} + kInfinity : hi, either(lost, maybe_nan)};
}
// From the ends of what is monotone along both arguments.
template <class X>
Bounds<X> over_corners(const X& p, const X& q, const X& r, const X& s, const MaskOf<X>& maybe_nan) {
  using lanes::smaller, lanes::larger;
  const auto lost = either(either(is_nan(p), is_nan(q)), either(is_nan(r), is_nan(s)));
  return bounded(smaller(smaller(p, q), smaller(r, s)), larger(larger(p, q), larger(r, s)), lost,
                 maybe_nan);
}
template <class X>
MaskOf<X> maybe_nan(const Bounds<X>& a, const Bounds<X>& b) {
  return either(either(a.maybe_nan, b.maybe_nan), infinite(a, b));
}

}  // namespace detail

template <class X>
Bounds<X> operator+(const Bounds<X>& a, const Bounds<X>& b) {
  const X lo = a.lo + b.lo, hi = a.hi + b.hi;
  return detail::bounded(lo, hi, detail::either(detail::is_nan(lo), detail::is_nan(hi)),
                         detail::maybe_nan(a, b));
}
template <class X>
Bounds<X> operator-(const Bounds<X>& a) {
  return {-a.hi, -a.lo, a.maybe_nan};
}
template <class X>
Bounds<X> operator-(const Bounds<X>& a, const Bounds<X>& b) {
  return a + -b;
}
template <class X>
Bounds<X> operator*(const Bounds<X>& a, const Bounds<X>& b) {
  return detail::over_corners(X(a.lo * b.lo), X(a.lo * b.hi), X(a.hi * b.lo), X(a.hi * b.hi),
                              detail::maybe_nan(a, b));
}
template <class X>
Bounds<X> operator/(const Bounds<X>& a, const Bounds<X>& b) {
  const Bounds<X> q = detail::over_corners(X(a.lo / b.lo), X(a.lo / b.hi), X(a.hi / b.lo),
                                           X(a.hi / b.hi), detail::maybe_nan(a, b));
  const auto by_zero = static_cast<MaskOf<X>>((b.lo <= 0.0) & (b.hi >= 0.0));
  return detail::bounded(q.lo, q.hi, by_zero, q.maybe_nan);
}

// Numbers in, numbers out: not a number if an argument is not.
template <class X>
X absolute(const X& a) {
  return lanes::magnitude(a);
}
template <class X>
X minimum(const X& a, const X& b) {
  return detail::either<MaskOf<X>>(b < a, b != b) ? b : a;
}
template <class X>
X maximum(const X& a, const X& b) {
  return detail::either<MaskOf<X>>(a < b, b != b) ? b : a;
}
template <class X>
X floor_of(const X& a) {
  return lanes::floor(a);
}
template <class X>
X square(const X& a) {
  return a * a;
}
template <class X>
X root(const X& a) {
  return lanes::sqrt(a);
}
template <class X>
X remainder(const X& a, const X& b) {  // a - b floor(a / b)
  return a - b * lanes::floor(X(a / b));
}
template <class X>
X ease(const X& t) {  // from 0 to 1 as its argument does, level at both ends
  return t * t * (3.0 - 2.0 * t);
}
double power(double a, double b);

template <class X>
Bounds<X> absolute(const Bounds<X>& a) {
  return {lanes::above_zero(lanes::larger(a.lo, X(-a.hi))), lanes::larger(X(-a.lo), a.hi),
          a.maybe_nan};
}
template <class X>
Bounds<X> minimum(const Bounds<X>& a, const Bounds<X>& b) {
  return {lanes::smaller(a.lo, b.lo), lanes::smaller(a.hi, b.hi),
          detail::either(a.maybe_nan, b.maybe_nan)};
}
template <class X>
Bounds<X> maximum(const Bounds<X>& a, const Bounds<X>& b) {
  return {lanes::larger(a.lo, b.lo), lanes::larger(a.hi, b.hi),
          detail::either(a.maybe_nan, b.maybe_nan)};
}
template <class X>
Bounds<X> floor_of(const Bounds<X>& a) {
  return {lanes::floor(a.lo), lanes::floor(a.hi), a.maybe_nan};
}
template <class X>
Bounds<X> square(const Bounds<X>& a) {
  const Bounds<X> size = absolute(a);
  return {size.lo * size.lo, size.hi * size.hi, a.maybe_nan};
}
template <class X>
Bounds<X> root(const Bounds<X>& a) {
  return detail::bounded(lanes::sqrt(lanes::above_zero(a.lo)), lanes::sqrt(lanes::above_zero(a.hi)),
                         MaskOf<X>(a.hi < 0.0), detail::either<MaskOf<X>>(a.maybe_nan, a.lo < 0.0));
}
Interval remainder(const Interval& a, const Interval& b);
Interval power(const Interval& a, const Interval& b);
Interval ease(const Interval& t);  // within [0, 1]
Interval sine(const Interval& a);
Interval cosine(const Interval& a);
Interval exponential(const Interval& a);
Interval logarithm(const Interval& a);
Interval angle_of(const Interval& y, const Interval& x);

// Truth as a number: 0 is false, 1 is true, 1/2 unknown (a comparison with what is not a number).
// So `and` is the minimum of two truths, `or` the maximum, `not` what lacks to 1.
template <class X>
X truth_of(const MaskOf<X>& holds, const MaskOf<X>& fails) {
  const X zero{}, one = zero + 1.0, unknown = zero + 0.5;
  return holds ? one : fails ? zero : unknown;
}
template <class X>
X less(const X& a, const X& b) {
  return truth_of<X>(a < b, a >= b);
}
template <class X>
X less_equal(const X& a, const X& b) {
  return truth_of<X>(a <= b, a > b);
}
// What a comparison can be that can hold, can fail, and can be one with what is no number.
template <class X>
Bounds<X> truths_of(const MaskOf<X>& can_hold, const MaskOf<X>& can_fail,
                    const MaskOf<X>& maybe_nan) {
  const X zero{}, one = zero + 1.0, unknown = zero + 0.5;
  const X least = maybe_nan ? unknown : one, most = maybe_nan ? unknown : zero;
  return {can_fail ? zero : least, can_hold ? one : most, MaskOf<X>{}};
}
template <class X>
Bounds<X> less(const Bounds<X>& a, const Bounds<X>& b) {
  return truths_of<X>(a.lo < b.hi, a.hi >= b.lo, detail::either(a.maybe_nan, b.maybe_nan));
}
template <class X>
Bounds<X> less_equal(const Bounds<X>& a, const Bounds<X>& b) {
  return truths_of<X>(a.lo <= b.hi, a.hi > b.lo, detail::either(a.maybe_nan, b.maybe_nan));
}

}  // namespace talus
