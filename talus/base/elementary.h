// Elementary functions with the same bits on every machine, which the C library's do not promise:
// additions, multiplications, divisions and exact operations alone. The series are those of fdlibm
// (Sun Microsystems, 1993).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace talus {

namespace detail {

// c[0] + z c[1] + z^2 c[2] + ...
template <std::size_t N>
constexpr double polynomial(double z, const std::array<double, N>& c) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i > 0; --i) sum = sum * z + c[i - 1];
  return sum;
}

// Of angles up to a little more than a quarter of pi.
constexpr double sine_near_zero(double r) {
  constexpr std::array<double, 6> kSeries = {
      -1.66666666666666324348e-01, 8.33333333332248946124e-03,  -1.98412698298579493134e-04,
      2.75573137070700676789e-06,  -2.50507602534068634195e-08, 1.58969099521155010221e-10};
  return r + r * r * r * polynomial(r * r, kSeries);
}
constexpr double cosine_near_zero(double r) {
  constexpr std::array<double, 6> kSeries = {
      4.16666666666666019037e-02,  -1.38888888888741095749e-03, 2.48015872894767294178e-05,
      -2.75573143513906633035e-07, 2.08757232129817482790e-09,  -1.13596475577881948265e-11};
  const double z = r * r;
  return 1 - (0.5 * z - z * z * polynomial(z, kSeries));
}

// The sine of x + quarters pi / 2.
inline double sine_shifted(double x, int quarters) {
  constexpr double kHigh = 1.57079632673412561417, kLow = 6.07710050650619224932e-11;
  if (!(std::abs(x) <= 0x1p30)) return std::numeric_limits<double>::quiet_NaN();
  const double turns = std::floor(x * (2 / std::numbers::pi) + 0.5);
  const double r = (x - turns * kHigh) - turns * kLow;
  const int quarter = (static_cast<int>(turns) + quarters) & 3;
  const double value = quarter & 1 ? cosine_near_zero(r) : sine_near_zero(r);
  return quarter & 2 ? -value : value;
}

}  // namespace detail

// Of radians; within 4e-16 + 1e-16 |x|. Not a number beyond 2^30, where angles blur.
inline double sine(double x) { return detail::sine_shifted(x, 0); }
inline double cosine(double x) { return detail::sine_shifted(x, 1); }

// The angle of (x, y) from the x axis, in [-pi, pi], within 1e-15; 0 at the origin.
inline double angle_of(double y, double x) {
  constexpr std::array<double, 11> kSeries = {
      3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,
      -1.11111104054623557880e-01, 9.09088713343650656196e-02,  -7.69187620504482999495e-02,
      6.66107313738753120669e-02,  -5.83357013379057348645e-02, 4.97687799461593236017e-02,
      -3.65315727442169155270e-02, 1.62858201153657823623e-02};
  constexpr double kPi = std::numbers::pi;
  if (x == 0 && y == 0) return 0;
  // Of the first eighth of the plane, then unfolded.
  const double ax = std::abs(x), ay = std::abs(y);
  double ratio = ay < ax ? ay / ax : ax / ay;
  const bool steep = ratio > 0.4142;
  if (steep) ratio = (ratio - 1) / (ratio + 1);
  const double z = ratio * ratio;
  double angle = ratio - ratio * z * detail::polynomial(z, kSeries);
  if (steep) angle += kPi / 4;
  if (!(ay < ax)) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

// Within a part in 1e15; 0 and infinity beyond what a double holds.
inline double exponential(double x) {
  constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10;
  constexpr std::array<double, 5> kSeries = {
      1.66666666666666019037e-01, -2.77777777770155933842e-03, 6.61375632143793436117e-05,
      -1.65339022054652515390e-06, 4.13813679705723846039e-08};
  if (std::isnan(x)) return x;
  if (x > 709.7) return std::numeric_limits<double>::infinity();
  if (x < -708) return 0;
  const double twos = std::floor(x / std::numbers::ln2 + 0.5);
  const double high = x - twos * kHigh, low = twos * kLow, r = high - low;
  const double c = r - r * r * detail::polynomial(r * r, kSeries);
  return std::ldexp(1 - ((low - r * c / (2 - c)) - high), static_cast<int>(twos));
}

// The natural one, within 1e-15 of its value or of 1; minus infinity at 0, not a number below.
inline double logarithm(double x) {
  constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10;
  constexpr std::array<double, 7> kSeries = {6.666666666666735130e-01, 3.999999999940941908e-01,
                                             2.857142874366239149e-01, 2.222219843214978396e-01,
                                             1.818357216161805012e-01, 1.531383769920937332e-01,
                                             1.479819860511658591e-01};
  if (!(x > 0)) return x == 0 ? -std::numeric_limits<double>::infinity() : std::nan("");
  if (std::isinf(x)) return x;
  int twos = 0;
  double f = std::frexp(x, &twos);
  if (f < std::numbers::sqrt2 / 2) {
    f *= 2;
    --twos;
  }
  f -= 1;
  const double s = f / (2 + f), half = 0.5 * f * f;
  const double rest = s * s * detail::polynomial(s * s, kSeries);
  return twos * kHigh - ((half - (s * (half + rest) + twos * kLow)) - f);
}

}  // namespace talus
