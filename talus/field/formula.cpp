#include "talus/field/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

#include "talus/base/error.h"
#include "talus/field/interval.h"

namespace talus {
namespace {

using Op = FormulaProgram::Op;

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

// Where a value is not the same: bits 0 and 1 of a row of four points along x, its place along y in
// the block; bits 2 and 3 that along z; bit 4 the points of a row.
using Axes = std::uint32_t;
constexpr std::array<Axes, 3> kAlong = {16, 3, 12};
constexpr Axes kRows = 15, kInRow = 16;

// Values of one point or box, or of four side by side.
template <class V>
struct Row {
  using One = V;
};
template <>
struct Row<Doubles> {
  using One = double;
  static double get(const Doubles& row, std::size_t k) { return row[k]; }
  static void set(Doubles& row, std::size_t k, double value) { row[k] = value; }
};
template <>
struct Row<Intervals> {
  using One = Interval;
  static Interval get(const Intervals& row, std::size_t k) {
    return {row.lo[k], row.hi[k], row.maybe_nan[k] != 0};
  }
  static void set(Intervals& row, std::size_t k, const Interval& value) {
    row.lo[k] = value.lo;
    row.hi[k] = value.hi;
    row.maybe_nan[k] = value.maybe_nan ? -1 : 0;
  }
};

// Runs a program for the sixteen rows of a block, or for one point or box. A value is computed once
// for all rows that it is the same in: of row i, at i & axes.
template <class V, std::size_t kCount>
class Machine {
 public:
  using One = typename Row<V>::One;
  struct Rows {
    Axes axes = 0;
    std::array<V, kCount> values;
    const V& operator[](std::size_t i) const { return values[i & axes & kRows]; }
  };

  Machine(const FormulaProgram& program, const GradientNoise& noise)
      : program_(program),
        noise_(noise),
        stack_(std::make_unique_for_overwrite<Rows[]>(static_cast<std::size_t>(program.depth))) {}

  const Rows& run(const std::array<Rows, 3>& place) {
    for (const FormulaProgram::Step& step : program_.steps) apply(step, place);
    return stack_[0];
  }

 private:
  // Replaces `a` by what a function gives for every row. From the last one down, as a row reads
  // what lies before it.
  void set(Rows& a, Axes axes, auto&& value_of_row) {
    for (Axes i = axes & kRows;; i = (i - 1) & axes & kRows) {
      a.values[i] = value_of_row(i);
      if (i == 0) break;
    }
    a.axes = axes;
  }
  void push(const Rows& rows) {
    set(stack_[depth_++], rows.axes, [&](std::size_t i) { return rows[i]; });
  }
  void unary(auto&& f) {
    Rows& a = stack_[depth_ - 1];
    set(a, a.axes, [&](std::size_t i) { return f(a[i]); });
  }
  void binary(auto&& f) {
    --depth_;
    Rows& a = stack_[depth_ - 1];
    const Rows& b = stack_[depth_];
    set(a, a.axes | b.axes, [&](std::size_t i) { return f(a[i], b[i]); });
  }
  void ternary(auto&& f) {
    depth_ -= 2;
    Rows& a = stack_[depth_ - 1];
    const Rows& b = stack_[depth_];
    const Rows& c = stack_[depth_ + 1];
    set(a, a.axes | b.axes | c.axes, [&](std::size_t i) { return f(a[i], b[i], c[i]); });
  }
  // A function of one value as one of a row.
  template <class F>
  static auto along(Axes axes, F f) {
    return [axes, f](const auto&... rows) -> V {
      if constexpr (std::is_same_v<V, One>) {
        return f(rows...);
      } else {
        V result;
        One one{};
        for (std::size_t k = 0; k < kDoubleLanes; ++k) {
          if (k == 0 || (axes & kInRow)) one = f(Row<V>::get(rows, k)...);
          Row<V>::set(result, k, one);
        }
        return result;
      }
    };
  }
  void unary_one(auto&& f) { unary(along(stack_[depth_ - 1].axes, f)); }
  void binary_one(auto&& f) { binary(along(stack_[depth_ - 1].axes | stack_[depth_ - 2].axes, f)); }
  void ternary_one(auto&& f) {
    ternary(along(stack_[depth_ - 1].axes | stack_[depth_ - 2].axes | stack_[depth_ - 3].axes, f));
  }

  void apply(const FormulaProgram::Step& step, const std::array<Rows, 3>& place);

  const FormulaProgram& program_;
  const GradientNoise& noise_;
  std::size_t depth_ = 0;
  std::unique_ptr<Rows[]> stack_;
};

template <class V>
V constant(double value) {
  if constexpr (requires(V v) { v.lo; }) {
    const auto end = constant<decltype(V::lo)>(value);
    return V{.lo = end, .hi = end, .maybe_nan = {}};
  } else {
    return V{} + value;
  }
}

template <class V, std::size_t kCount>
void Machine<V, kCount>::apply(const FormulaProgram::Step& step, const std::array<Rows, 3>& place) {
  const V kZero = constant<V>(0), kOne = constant<V>(1);
  switch (step.op) {
    case Op::number:
      return push({.values = {constant<V>(step.value)}});
    case Op::x:
      return push(place[0]);
    case Op::y:
      return push(place[1]);
    case Op::z:
      return push(place[2]);
    case Op::add:
      return binary([](const V& a, const V& b) -> V { return a + b; });
    case Op::subtract:
      return binary([](const V& a, const V& b) -> V { return a - b; });
    case Op::multiply:
      return binary([](const V& a, const V& b) -> V { return a * b; });
    case Op::divide:
      return binary([](const V& a, const V& b) -> V { return a / b; });
    case Op::power:
      return binary_one([](const One& a, const One& b) { return power(a, b); });
    case Op::negate:
      return unary([](const V& a) -> V { return -a; });
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
      return unary([&](const V& a) -> V { return kOne - a; });
    case Op::abs:
      return unary([](const V& a) { return absolute(a); });
    case Op::clamp:
      return ternary(
          [](const V& a, const V& low, const V& high) { return minimum(maximum(a, low), high); });
    case Op::floor:
      return unary([](const V& a) { return floor_of(a); });
    case Op::ceil:
      return unary([](const V& a) -> V { return -floor_of(V(-a)); });
    case Op::fract:
      return unary_one([](const One& a) { return remainder(a, constant<One>(1)); });
    case Op::mod:
      return binary_one([](const One& a, const One& b) { return remainder(a, b); });
    case Op::sqrt:
      return unary([](const V& a) { return root(a); });
    case Op::hypot:
      return binary([](const V& a, const V& b) { return root(V(square(a) + square(b))); });
    case Op::length:
      return ternary([](const V& a, const V& b, const V& c) {
        return root(V(square(a) + square(b) + square(c)));
      });
    case Op::sin:
      return unary_one([](const One& a) { return sine(a); });
    case Op::cos:
      return unary_one([](const One& a) { return cosine(a); });
    case Op::tan:
      return unary_one([](const One& a) { return sine(a) / cosine(a); });
    case Op::atan2:
      return binary_one([](const One& a, const One& b) { return angle_of(a, b); });
    case Op::exp:
      return unary_one([](const One& a) { return exponential(a); });
    case Op::log:
      return unary_one([](const One& a) { return logarithm(a); });
    case Op::mix:
      return ternary([](const V& a, const V& b, const V& t) -> V { return a + t * (b - a); });
    case Op::smoothstep:
      return ternary_one([](const One& from, const One& to, const One& a) {
        const One share = (a - from) / (to - from);
        return ease(minimum(maximum(share, constant<One>(0)), constant<One>(1)));
      });
    case Op::step:
      // The difference keeps what is no number.
      return binary(
          [&](const V& edge, const V& a) -> V { return less_equal(edge, a) + kZero * (a - edge); });
    case Op::noise:
      return ternary_one(
          [&](const One& x, const One& y, const One& z) { return noise_at(noise_, x, y, z); });
  }
}

using Points = Machine<Doubles, 16>;
using Boxes = Machine<Intervals, 16>;

// Where a coordinate of a block's points changes.
Axes axes_of(const PointBlock& block, int coordinate) {
  Axes axes = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (block.step[axis][coordinate] != 0) axes |= kAlong[axis];
  return axes;
}

// Of the points of a block, and what a function makes of it.
template <class V>
typename Machine<V, 16>::Rows coordinate_of(const PointBlock& block, int coordinate,
                                            auto&& value_of) {
  typename Machine<V, 16>::Rows rows;
  rows.axes = axes_of(block, coordinate);
  for (Axes i = rows.axes & kRows;; i = (i - 1) & rows.axes & kRows) {
    Doubles row;
    for (std::size_t k = 0; k < kDoubleLanes; ++k)
      row[k] = block.point(static_cast<int>(4 * i + k))[coordinate];
    rows.values[i] = value_of(row);
    if (i == 0) break;
  }
  return rows;
}

bool is_true(double truth) { return truth == 1; }

bool reaches_out(const Box3& box, const Box3& bounds) {
  return !(bounds.contains(box.min) && bounds.contains(box.max));
}

}  // namespace

FormulaSupport::FormulaSupport(std::string_view condition, const Box3& bounds, std::uint64_t seed)
    : program_(parse_formula(condition)), bounds_(bounds), noise_(seed) {
  const Vec3 size = bounds.size();
  if (!(std::min({size.x, size.y, size.z}) > 0))
    throw usage_error("the box of the formula has no volume; min must be below max along x, y, z");
}

bool FormulaSupport::contains(const Vec3& p) const {
  if (!bounds_.contains(p)) return false;
  Machine<double, 1> machine(program_, noise_);
  return is_true(machine.run({{{.values = {p.x}}, {.values = {p.y}}, {.values = {p.z}}}})[0]);
}

std::uint64_t FormulaSupport::contains_block(const PointBlock& block) const {
  const auto along = [&](int axis) {
    return coordinate_of<Doubles>(block, axis, [](const Doubles& x) { return x; });
  };
  Points machine(program_, noise_);
  const Points::Rows& truth = machine.run({along(0), along(1), along(2)});
  std::uint64_t bits = 0;
  for (std::size_t row = 0; row < 16; ++row) bits |= bits_of(truth[row] == 1.0) << (4 * row);
  if (!reaches_out(block.box_around(Vec3(0)), bounds_)) return bits;
  for (int i = 0; i < kBlockPoints; ++i)
    if (!bounds_.contains(block.point(i))) bits &= ~(std::uint64_t{1} << i);
  return bits;
}

BoxState FormulaSupport::classify(const Box3& box) const {
  const Box3 part{glm::max(box.min, bounds_.min), glm::min(box.max, bounds_.max)};
  if (part.empty()) return BoxState::outside;
  using OneBox = Machine<Interval, 1>;
  const auto along = [&](int axis) {
    return OneBox::Rows{.values = {Interval{part.min[axis], part.max[axis]}}};
  };
  OneBox machine(program_, noise_);
  const Interval truth = machine.run({along(0), along(1), along(2)})[0];
  if (truth.hi < 1) return BoxState::outside;
  return truth.lo == 1 && !reaches_out(box, bounds_) ? BoxState::inside : BoxState::mixed;
}

BlockStates FormulaSupport::classify_block(const PointBlock& centers, const Vec3& half) const {
  const auto along = [&](int axis) {
    return coordinate_of<Intervals>(centers, axis, [&](const Doubles& x) {
      return Intervals{x - half[axis], x + half[axis], {}};
    });
  };
  Boxes machine(program_, noise_);
  const Boxes::Rows& truth = machine.run({along(0), along(1), along(2)});
  BlockStates states;
  for (std::size_t row = 0; row < 16; ++row) {
    states.outside |= bits_of(truth[row].hi < 1.0) << (4 * row);
    states.inside |= bits_of(truth[row].lo == 1.0) << (4 * row);
  }
  if (!reaches_out(centers.box_around(half), bounds_)) return states;
  for (int i = 0; i < kBlockPoints; ++i) {
    const Box3 box{centers.point(i) - half, centers.point(i) + half};
    const Box3 part{glm::max(box.min, bounds_.min), glm::min(box.max, bounds_.max)};
    states.outside |= std::uint64_t{part.empty()} << i;
    if (reaches_out(box, bounds_)) states.inside &= ~(std::uint64_t{1} << i);
  }
  return states;
}

}  // namespace talus
