#include "talus/field/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "talus/base/error.h"
#include "talus/field/interval.h"

namespace talus {
namespace {

using Op = FormulaProgram::Op;

constexpr int kRow = 64;  // points evaluated together

double noise_at(const GradientNoise& noise, double x, double y, double z) {
  constexpr double kFarthest = 1e15;  // beyond, doubles are hardly finer than the noise
  // Written so that what is not a number is not near.
  const bool near = std::abs(x) < kFarthest && std::abs(y) < kFarthest && std::abs(z) < kFarthest;
  return near ? noise.at(Vec3(x, y, z)).x : std::numeric_limits<double>::quiet_NaN();
}

Interval noise_at(const GradientNoise& noise, const Interval& x, const Interval& y,
                  const Interval& z) {
  // Along an axis the slope of a lattice point's plane is at most 1. The weight of one point of a
  // pair changes by at most 15/8 in a unit, from one plane to the other, which are apart by at most
  // twice the sum of the distances to the point, 1.5 on average over the four pairs.
  constexpr double kSteepest = 1 + 15.0 / 8 * 2 * 1.5;
  const auto middle = [](const Interval& a) { return 0.5 * (a.lo + a.hi); };
  const double change = 0.5 * kSteepest * ((x.hi - x.lo) + (y.hi - y.lo) + (z.hi - z.lo)) + 1e-12;
  const double value = noise_at(noise, middle(x), middle(y), middle(z));
  const bool far = !(std::max({-x.lo, x.hi, -y.lo, y.hi, -z.lo, z.hi}) < 1e9);
  if (far || !(change < 2)) return {-1, 1, true};
  return {std::max(-1.0, value - change), std::min(1.0, value + change),
          x.maybe_nan || y.maybe_nan || z.maybe_nan};
}

// Runs a program for `count` points at once, or with V = Interval for a box.
template <class V, int kLanes>
class Machine {
 public:
  using Lanes = std::array<V, kLanes>;

  Machine(const GradientNoise& noise, int count) : noise_(noise), count_(count) {}

  const Lanes& run(const FormulaProgram& program, const std::array<Lanes, 3>& place) {
    for (const FormulaProgram::Step& step : program.steps) apply(step, place);
    return stack_[0];
  }

 private:
  void push(auto&& value_of_lane) {
    Lanes& lanes = stack_[depth_++];
    for (std::size_t i = 0; i < count(); ++i) lanes[i] = value_of_lane(i);
  }
  void unary(auto&& f) {
    Lanes& a = stack_[depth_ - 1];
    for (std::size_t i = 0; i < count(); ++i) a[i] = f(a[i]);
  }
  void binary(auto&& f) {
    --depth_;
    Lanes& a = stack_[depth_ - 1];
    const Lanes& b = stack_[depth_];
    for (std::size_t i = 0; i < count(); ++i) a[i] = f(a[i], b[i]);
  }
  void ternary(auto&& f) {
    depth_ -= 2;
    Lanes& a = stack_[depth_ - 1];
    const Lanes& b = stack_[depth_];
    const Lanes& c = stack_[depth_ + 1];
    for (std::size_t i = 0; i < count(); ++i) a[i] = f(a[i], b[i], c[i]);
  }
  std::size_t count() const { return static_cast<std::size_t>(count_); }

  void apply(const FormulaProgram::Step& step, const std::array<Lanes, 3>& place);

  const GradientNoise& noise_;
  int count_;
  std::size_t depth_ = 0;
  std::array<Lanes, FormulaProgram::kStackMax> stack_;
};

template <class V>
constexpr V constant(double value) {
  if constexpr (std::is_same_v<V, Interval>)
    return {value, value};
  else
    return value;
}

template <class V, int kLanes>
void Machine<V, kLanes>::apply(const FormulaProgram::Step& step,
                               const std::array<Lanes, 3>& place) {
  static constexpr V kZero = constant<V>(0), kOne = constant<V>(1);
  const auto clamp = [](const V& a, const V& low, const V& high) {
    return minimum(maximum(a, low), high);
  };
  switch (step.op) {
    case Op::number:
      return push([v = constant<V>(step.value)](std::size_t) { return v; });
    case Op::x:
      return push([&](std::size_t i) { return place[0][i]; });
    case Op::y:
      return push([&](std::size_t i) { return place[1][i]; });
    case Op::z:
      return push([&](std::size_t i) { return place[2][i]; });
    case Op::add:
      return binary([](const V& a, const V& b) { return a + b; });
    case Op::subtract:
      return binary([](const V& a, const V& b) { return a - b; });
    case Op::multiply:
      return binary([](const V& a, const V& b) { return a * b; });
    case Op::divide:
      return binary([](const V& a, const V& b) { return a / b; });
    case Op::power:
      return binary([](const V& a, const V& b) { return power(a, b); });
    case Op::negate:
      return unary([](const V& a) { return -a; });
    case Op::less:
      return binary([](const V& a, const V& b) { return less(a, b); });
    case Op::less_equal:
      return binary([](const V& a, const V& b) { return less_equal(a, b); });
    case Op::both:
    case Op::min:
      return binary([](const V& a, const V& b) { return minimum(a, b); });
    case Op::either:
    case Op::max:
      return binary([](const V& a, const V& b) { return maximum(a, b); });
    case Op::negation:
      return unary([](const V& a) { return kOne - a; });
    case Op::abs:
      return unary([](const V& a) { return absolute(a); });
    case Op::clamp:
      return ternary(clamp);
    case Op::floor:
      return unary([](const V& a) { return floor_of(a); });
    case Op::ceil:
      return unary([](const V& a) { return -floor_of(-a); });
    case Op::fract:
      return unary([](const V& a) { return remainder(a, kOne); });
    case Op::mod:
      return binary([](const V& a, const V& b) { return remainder(a, b); });
    case Op::sqrt:
      return unary([](const V& a) { return root(a); });
    case Op::hypot:
      return binary([](const V& a, const V& b) { return root(square(a) + square(b)); });
    case Op::length:
      return ternary([](const V& a, const V& b, const V& c) {
        return root(square(a) + square(b) + square(c));
      });
    case Op::sin:
      return unary([](const V& a) { return sine(a); });
    case Op::cos:
      return unary([](const V& a) { return cosine(a); });
    case Op::tan:
      return unary([](const V& a) { return sine(a) / cosine(a); });
    case Op::atan2:
      return binary([](const V& a, const V& b) { return angle_of(a, b); });
    case Op::exp:
      return unary([](const V& a) { return exponential(a); });
    case Op::log:
      return unary([](const V& a) { return logarithm(a); });
    case Op::mix:
      return ternary([](const V& a, const V& b, const V& t) { return a + t * (b - a); });
    case Op::smoothstep:
      return ternary([&](const V& from, const V& to, const V& a) {
        return ease(clamp((a - from) / (to - from), kZero, kOne));
      });
    case Op::step:
      // The difference keeps what is no number.
      return binary(
          [](const V& edge, const V& a) { return less_equal(edge, a) + kZero * (a - edge); });
    case Op::noise:
      return ternary([&](const V& x, const V& y, const V& z) { return noise_at(noise_, x, y, z); });
  }
}

}  // namespace

FormulaSupport::FormulaSupport(std::string_view condition, const Box3& bounds, std::uint64_t seed)
    : program_(parse_formula(condition)), bounds_(bounds), noise_(seed) {
  const Vec3 size = bounds.size();
  if (!(std::min({size.x, size.y, size.z}) > 0))
    throw usage_error("the box of the formula has no volume; min must be below max along x, y, z");
}

std::uint64_t FormulaSupport::contains_row(const Vec3& first, const Vec3& step, int count) const {
  std::array<std::array<double, kRow>, 3> place;
  std::uint64_t in_bounds = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = first + static_cast<double>(i) * step;
    in_bounds |= std::uint64_t{bounds_.contains(p)} << i;
    for (int axis = 0; axis < 3; ++axis)
      place[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)] = p[axis];
  }
  if (in_bounds == 0) return 0;
  Machine<double, kRow> machine(noise_, count);
  const auto& truth = machine.run(program_, place);
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i)
    bits |= std::uint64_t{truth[static_cast<std::size_t>(i)] == 1} << i;
  return bits & in_bounds;
}

BoxState FormulaSupport::classify(const Box3& box) const {
  const Box3 part{glm::max(box.min, bounds_.min), glm::min(box.max, bounds_.max)};
  if (part.empty()) return BoxState::outside;
  const auto along = [&](int axis) { return std::array{Interval{part.min[axis], part.max[axis]}}; };
  Machine<Interval, 1> machine(noise_, 1);
  const Interval truth = machine.run(program_, {along(0), along(1), along(2)})[0];
  if (truth.hi < 1) return BoxState::outside;
  const bool reaches_out = part.min != box.min || part.max != box.max;
  return truth.lo == 1 && !reaches_out ? BoxState::inside : BoxState::mixed;
}

}  // namespace talus
