#include "talus/field/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/lanes.h"

namespace talus {

// One kind of shape.
class DistanceFunction::Implementation {
 public:
  virtual ~Implementation() = default;
  virtual double at(const Vec3& p) const = 0;
  virtual void along(const Vec3& first, const Vec3& step, std::span<double> distances) const = 0;
};

namespace {

constexpr std::size_t kRowMax = 64;  // points that are asked for at once
constexpr double kEndless = 4e9;     // farther than any place may be

// The arithmetic of distances is that of one number or of several side by side, to the same bits.
using std::sqrt;
using talus::sqrt;
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

struct SphereDistance {
  Sphere s;
  template <class X>
  X operator()(const Point<X>& p) const {
    const Point<X> q = p - s.center;
    return length(q.x, q.y, q.z) - s.radius;
  }
};

struct BoxDistance {
  Box b;
  template <class X>
  X operator()(const Point<X>& p) const {
    const Point<X> q = p - b.center;
    const Vec3 half = 0.5 * b.size - b.rounding;
    const X x = magnitude(q.x) - half.x, y = magnitude(q.y) - half.y, z = magnitude(q.z) - half.z;
    const X outside = length(above_zero(x), above_zero(y), above_zero(z));
    return outside + below_zero(larger(larger(x, y), z)) - b.rounding;
  }
};

// A capsule neither of whose spheres holds the other. In the half-plane through the axis and a
// point the surface is two arcs and their tangent.
class CapsuleDistance {
 public:
  explicit CapsuleDistance(const Capsule& c)
      : capsule_(c),
        axis_(c.to - c.from),
        length_(glm::length(axis_)),
        sine_((c.from_radius - c.to_radius) / length_),
        cosine_(std::sqrt(1 - sine_ * sine_)) {}

  template <class X>
  X operator()(const Point<X>& p) const {
    const Point<X> q = p - capsule_.from;
    const X along = dot(q, axis_) / length_;
    const X squared = q.x * q.x + q.y * q.y + q.z * q.z;
    const X across = sqrt(above_zero(squared - along * along));
    const X on_tangent = along * cosine_ - across * sine_;
    const X to_start = length(along, across) - capsule_.from_radius;
    const X to_end = length(along - length_, across) - capsule_.to_radius;
    const X to_side = along * sine_ + across * cosine_ - capsule_.from_radius;
    const X beyond_start = on_tangent > length_ * cosine_ ? to_end : to_side;
    return on_tangent < 0.0 ? to_start : beyond_start;
  }

 private:
  Capsule capsule_;
  Vec3 axis_;
  double length_, sine_, cosine_;
};

struct CylinderDistance {
  Cylinder c;
  template <class X>
  X operator()(const Point<X>& p) const {
    const Point<X> q = p - c.base;
    const X across = length(q.x, q.y) - c.radius;
    const X along = magnitude(q.z - 0.5 * c.height) - 0.5 * c.height;
    return length(above_zero(across), above_zero(along)) + below_zero(larger(across, along));
  }
};

struct HalfSpaceDistance {
  explicit HalfSpaceDistance(const HalfSpace& h)
      : point(h.point), normal(h.normal), length(glm::length(normal)) {}
  template <class X>
  X operator()(const Point<X>& p) const {
    return dot(p - point, normal) / length;
  }
  Vec3 point, normal;
  double length;
};

// Polynomial smooth minimum: 1-Lipschitz if both arguments are, at most `blend` / 4 below them.
template <class X>
X smooth_min(const X& a, const X& b, double blend) {
  if (blend <= 0) return smaller(a, b);
  const X h = above_zero(blend - magnitude(a - b)) / blend;
  return smaller(a, b) - 0.25 * h * h * blend;
}

template <class X>
X combine(Combination::Rule rule, const X& a, const X& b, double blend) {
  switch (rule) {
    case Combination::Rule::join:
      return smooth_min(a, b, blend);
    case Combination::Rule::subtract:
      return -smooth_min(X(-a), b, blend);
    case Combination::Rule::intersect:
      return -smooth_min(X(-a), X(-b), blend);
  }
  return a;
}

using Distance = DistanceFunction::Implementation;
std::shared_ptr<const Distance> distance_of(const Shape& shape);

class CombinationDistance final : public Distance {
 public:
  explicit CombinationDistance(const Combination& c) : rule_(c.rule), blend_(c.blend) {
    for (const Shape& part : c.parts) parts_.push_back(distance_of(part));
  }

  double at(const Vec3& p) const override {
    double d = parts_.front()->at(p);
    for (std::size_t i = 1; i < parts_.size(); ++i) d = combine(rule_, d, parts_[i]->at(p), blend_);
    return d;
  }
  void along(const Vec3& first, const Vec3& step, std::span<double> distances) const override {
    std::array<double, kRowMax> part;
    parts_.front()->along(first, step, distances);
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      parts_[i]->along(first, step, std::span(part).first(distances.size()));
      for (std::size_t k = 0; k < distances.size(); k += kDoubleLanes) {
        const auto a = load<Doubles>(&distances[k]), b = load<Doubles>(&part[k]);
        store(combine(rule_, a, b, blend_), &distances[k]);
      }
    }
  }

 private:
  Combination::Rule rule_;
  double blend_;
  std::vector<std::shared_ptr<const Distance>> parts_;
};

template <class Primitive>
class PrimitiveDistance final : public Distance {
 public:
  explicit PrimitiveDistance(const Primitive& primitive) : primitive_(primitive) {}

  double at(const Vec3& p) const override { return primitive_(Point<double>{p.x, p.y, p.z}); }
  void along(const Vec3& first, const Vec3& step, std::span<double> distances) const override {
    Doubles i = {0, 1, 2, 3};
    for (std::size_t k = 0; k < distances.size(); k += kDoubleLanes, i += kDoubleLanes) {
      const Point<Doubles> p = {first.x + i * step.x, first.y + i * step.y, first.z + i * step.z};
      store(primitive_(p), &distances[k]);
    }
  }

 private:
  Primitive primitive_;
};

// Patterns answer for one point after the other.
template <class Function>
class PatternDistance final : public Distance {
 public:
  explicit PatternDistance(const Function& function) : function_(function) {}

  double at(const Vec3& p) const override { return function_(p); }
  void along(const Vec3& first, const Vec3& step, std::span<double> distances) const override {
    for (std::size_t k = 0; k < distances.size(); ++k)
      distances[k] = function_(first + static_cast<double>(k) * step);
  }

 private:
  Function function_;
};

struct MakeDistance {
  using Result = std::shared_ptr<const Distance>;
  static Result of(auto primitive) {
    return std::make_shared<const PrimitiveDistance<decltype(primitive)>>(primitive);
  }
  static Result of_pattern(auto pattern) {
    return std::make_shared<const PatternDistance<decltype(pattern)>>(pattern);
  }
  Result operator()(const Sphere& s) const { return of(SphereDistance{s}); }
  Result operator()(const Box& b) const { return of(BoxDistance{b}); }
  Result operator()(const Cylinder& c) const { return of(CylinderDistance{c}); }
  Result operator()(const HalfSpace& h) const { return of(HalfSpaceDistance(h)); }
  Result operator()(const Capsule& c) const {
    const double longer = c.from_radius - c.to_radius;
    if (glm::length(c.to - c.from) > std::abs(longer)) return of(CapsuleDistance(c));
    return (*this)(longer > 0 ? Sphere{c.from, c.from_radius} : Sphere{c.to, c.to_radius});
  }
  Result operator()(const Raked& r) const { return of_pattern(RakedDistance(r)); }
  Result operator()(const Courses& c) const { return of_pattern(CoursesDistance{c}); }
  Result operator()(const Spiral& s) const { return of_pattern(SpiralDistance{s}); }
  Result operator()(const Combination& c) const {
    return std::make_shared<const CombinationDistance>(c);
  }
};

std::shared_ptr<const Distance> distance_of(const Shape& shape) {
  return std::visit(MakeDistance{}, shape);
}

Box3 loose_bounds(const Shape& shape);

struct LooseBounds {
  Box3 operator()(const Sphere& s) const { return {s.center - s.radius, s.center + s.radius}; }
  Box3 operator()(const Box& b) const { return {b.center - 0.5 * b.size, b.center + 0.5 * b.size}; }
  Box3 operator()(const Capsule& c) const {
    Box3 box{c.from - c.from_radius, c.from + c.from_radius};
    box.include({c.to - c.to_radius, c.to + c.to_radius});
    return box;
  }
  Box3 operator()(const Cylinder& c) const {
    return {c.base - Vec3(c.radius, c.radius, 0), c.base + Vec3(c.radius, c.radius, c.height)};
  }
  Box3 operator()(const HalfSpace&) const { return {Vec3(-kEndless), Vec3(kEndless)}; }
  Box3 operator()(const Raked& r) const { return bounds_of(r); }
  Box3 operator()(const Courses&) const { return {Vec3(-kEndless), Vec3(kEndless)}; }
  Box3 operator()(const Spiral& s) const { return bounds_of(s); }
  Box3 operator()(const Combination& c) const {
    Box3 box = loose_bounds(c.parts.front());
    if (c.rule == Combination::Rule::subtract) return box;
    for (std::size_t i = 1; i < c.parts.size(); ++i) {
      const Box3 part = loose_bounds(c.parts[i]);
      if (c.rule == Combination::Rule::join)
        box.include(part);
      else
        box = {glm::max(box.min, part.min), glm::min(box.max, part.max)};
    }
    // Every join may swell the surface by a quarter of the blend.
    const auto joins = static_cast<double>(c.parts.size() - 1);
    return c.rule == Combination::Rule::join ? box.expanded(0.25 * c.blend * joins) : box;
  }
};

Box3 loose_bounds(const Shape& shape) { return std::visit(LooseBounds{}, shape); }

BoxState classify_box(const DistanceFunction& distance, const Box3& box) {
  const double d = distance(box.center());
  const double radius = 0.5 * glm::length(box.size());
  if (d > radius) return BoxState::outside;
  if (d < -radius) return BoxState::inside;
  return BoxState::mixed;
}

// Grows `found` by the parts of `box` that may touch a shape, down to cells of size `tolerance`.
void collect_occupied(const DistanceFunction& distance, const Box3& box, double tolerance,
                      Box3& found) {
  if (found.contains(box.min) && found.contains(box.max)) return;
  const BoxState state = classify_box(distance, box);
  if (state == BoxState::outside) return;
  if (state == BoxState::inside || box.longest_side() <= tolerance) {
    found.include(box);
    return;
  }
  const Vec3 middle = box.center();
  for (int corner = 0; corner < 8; ++corner) {
    Box3 part = box;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1)
        part.min[axis] = middle[axis];
      else
        part.max[axis] = middle[axis];
    }
    collect_occupied(distance, part, tolerance, found);
  }
}

const Shape& validated(const Shape& shape) {
  std::visit(
      [](const auto& s) {
        using T = std::remove_cvref_t<decltype(s)>;
        if constexpr (std::is_same_v<T, Combination>) {
          if (s.parts.empty())
            throw usage_error("support.parts is empty; a combination needs at least one shape");
          detail::check_number("support.blend", Field{.unit = "m", .min = 0, .max = 1e9}, s.blend);
          for (const Shape& part : s.parts) validated(part);
        } else {
          validate(s, fmt::format("support.{}", T::kName));
          if constexpr (requires { check_pattern(s); }) check_pattern(s);
          if constexpr (std::is_same_v<T, HalfSpace>)
            if (!(glm::length(s.normal) > 0))
              throw usage_error("support.half_space.normal has no length; give a direction");
          if constexpr (std::is_same_v<T, Box>)
            if (2 * s.rounding > std::min({s.size.x, s.size.y, s.size.z}))
              throw usage_error(fmt::format(
                  "support.box.rounding = {} m is too large; it must be at most half the shortest "
                  "edge, {} m",
                  s.rounding, 0.5 * std::min({s.size.x, s.size.y, s.size.z})));
        }
      },
      shape);
  return shape;
}

}  // namespace

double DistanceFunction::operator()(const Vec3& p) const { return implementation_->at(p); }

std::uint64_t DistanceFunction::inside_along(const Vec3& first, const Vec3& step, int count) const {
  std::array<double, kRowMax> distances;
  const auto whole_lanes = (count + kDoubleLanes - 1) / kDoubleLanes * kDoubleLanes;
  implementation_->along(first, step,
                         std::span(distances).first(static_cast<std::size_t>(whole_lanes)));
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i)
    bits |= std::uint64_t{distances[static_cast<std::size_t>(i)] <= 0} << i;
  return bits;
}

DistanceFunction distance_function(const Shape& shape) {
  return DistanceFunction(distance_of(shape));
}

Box3 bounds(const Shape& shape) {
  const Box3 loose = loose_bounds(shape);
  if (!std::holds_alternative<Combination>(shape) || loose.empty()) return loose;
  // Blending and cutting leave the sum of the parts' boxes too large; find what is occupied.
  Box3 found;
  collect_occupied(distance_function(shape), loose, loose.longest_side() / 256, found);
  return found;
}

ShapeSupport::ShapeSupport(const Shape& shape)
    : distance_(distance_function(validated(shape))), bounds_(talus::bounds(shape)) {
  if (bounds_.empty())
    throw usage_error("the support's shapes leave nothing: their combination is empty");
}

BoxState ShapeSupport::classify(const Box3& box) const { return classify_box(distance_, box); }

}  // namespace talus
