// Interval arithmetic: what a function may be anywhere in a box.
#pragma once

#include <limits>

#include "talus/base/elementary.h"

namespace talus {

// Every value of a computation is in [lo, hi], or is not a number if `maybe_nan`. Functions of
// intervals hold for the functions of doubles below to the last bit, rounding included: the basic
// ones round monotonically, the others are widened by more than their error.
struct Interval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool maybe_nan = false;
};

Interval operator+(const Interval& a, const Interval& b);
Interval operator-(const Interval& a, const Interval& b);
Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);
Interval operator-(const Interval& a);

// Numbers in, numbers out: not a number if an argument is not.
double absolute(double a);
double minimum(double a, double b);
double maximum(double a, double b);
double floor_of(double a);
double square(double a);
double root(double a);
double remainder(double a, double b);  // a - b floor(a / b)
double power(double a, double b);
double ease(double t);  // from 0 to 1 as its argument does, level at both ends

Interval absolute(const Interval& a);
Interval minimum(const Interval& a, const Interval& b);
Interval maximum(const Interval& a, const Interval& b);
Interval floor_of(const Interval& a);
Interval square(const Interval& a);
Interval root(const Interval& a);
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
double less(double a, double b);
double less_equal(double a, double b);
Interval less(const Interval& a, const Interval& b);
Interval less_equal(const Interval& a, const Interval& b);

}  // namespace talus
