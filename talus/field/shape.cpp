#include "talus/field/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/field/distance_lanes.h"
#include "talus/field/pattern_distance.h"

namespace talus {

// One kind of shape.
class DistanceFunction::Implementation {
 public:
  virtual ~Implementation() = default;
  virtual double at(const Vec3& p) const = 0;
  virtual void at(const PointBlock& block, BlockDistances& distances) const = 0;
};

namespace {

constexpr double kEndless = 4e9;  // farther than any place may be

using namespace lanes;

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

using Distance = DistanceFunction::Implementation;
std::shared_ptr<const Distance> distance_of(const Shape& shape);

// f(x, y, z) for four points along x at once, and `plan(x, y)` before it once for all that are
// above one another.
template <class Plan, class Function>
void for_lanes(const PointBlock& block, BlockDistances& distances, Plan&& plan, Function&& f) {
  constexpr Doubles kAlong = {0, 1, 2, 3};
  for (int y = 0; y < 4; ++y) {
    Point<Doubles> p{};
    const auto place = [&](int axis, int z) {
      return block.first[axis] + kAlong * block.step[0][axis] + y * block.step[1][axis] +
             z * block.step[2][axis];
    };
    const bool is_upright = block.is_upright();
    decltype(plan(p.x, p.y)) planned{};
    for (int z = 0; z < 4; ++z) {
      p.z = place(2, z);
      if (z == 0 || !is_upright) {
        p.x = place(0, z);
        p.y = place(1, z);
        planned = plan(p.x, p.y);
      }
      store(f(p, planned), &distances[static_cast<std::size_t>(4 * y + 16 * z)]);
    }
  }
}

// Parts joined, their signs and that of the whole turned for what is cut or common: a - b is
// -(-a or b).
class CombinationDistance final : public Distance {
 public:
  explicit CombinationDistance(const Combination& c) : blend_(c.blend) {
    using Rule = Combination::Rule;
    sign_ = c.rule == Rule::join ? 1 : -1;
    for (const Shape& part : c.parts) {
      const bool is_first = parts_.empty();
      const bool is_turned = c.rule == Rule::intersect || (c.rule == Rule::subtract && is_first);
      parts_.push_back({distance_of(part), is_turned ? -1.0 : 1.0});
    }
  }

  double at(const Vec3& p) const override {
    double d = parts_.front().at(p);
    for (std::size_t i = 1; i < parts_.size(); ++i) d = smooth_min(d, parts_[i].at(p), blend_);
    return sign_ * d;
  }

  void at(const PointBlock& block, BlockDistances& distances) const override {
    bool is_first = true;
    BlockDistances part;
    for (const std::size_t i : near(block)) {
      parts_[i].distance->at(block, is_first ? distances : part);
      for (std::size_t k = 0; k < kBlockPoints; k += kDoubleLanes) {
        if (is_first) {
          store(parts_[i].sign * load<Doubles>(&distances[k]), &distances[k]);
        } else {
          const Doubles d = load<Doubles>(&distances[k]);
          store(smooth_min(d, Doubles(parts_[i].sign * load<Doubles>(&part[k])), blend_),
                &distances[k]);
        }
      }
      is_first = false;
    }
    for (double& d : distances) d *= sign_;
  }

 private:
  struct Part {
    std::shared_ptr<const Distance> distance;
    double sign;
    double at(const Vec3& p) const { return sign * distance->at(p); }
  };

  // The parts that show in a block. Distances change by at most a metre in a metre; of a part that
  // is farther than the nearest one by more than all blending can reach, not a bit shows.
  std::vector<std::size_t> near(const PointBlock& block) const {
    std::vector<double> from_middle;
    for (const Part& part : parts_) from_middle.push_back(part.at(block.middle()));
    const double nearest = *std::min_element(from_middle.begin(), from_middle.end());
    const double blending = (2 + 0.25 * static_cast<double>(parts_.size())) * blend_;
    const double reach = 2 * block.radius() + blending;
    const double farthest = nearest + reach + 1e-9 * (std::abs(nearest) + reach);
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (from_middle[i] <= farthest) near.push_back(i);
    return near;
  }

  double sign_;
  double blend_;
  std::vector<Part> parts_;
};

template <class Primitive>
class PrimitiveDistance final : public Distance {
 public:
  explicit PrimitiveDistance(const Primitive& primitive) : primitive_(primitive) {}

  double at(const Vec3& p) const override { return primitive_(Point<double>{p.x, p.y, p.z}); }
  void at(const PointBlock& block, BlockDistances& distances) const override {
    for_lanes(
        block, distances, [](const Doubles&, const Doubles&) { return 0; },
        [&](const Point<Doubles>& p, int) { return primitive_(p); });
  }

 private:
  Primitive primitive_;
};

template <class Pattern>
class PatternDistance final : public Distance {
 public:
  explicit PatternDistance(const Pattern& pattern) : pattern_(pattern) {}

  double at(const Vec3& p) const override {
    return pattern_.at(pattern_.plan(p.x, p.y, pattern_.everywhere()), p.z);
  }
  void at(const PointBlock& block, BlockDistances& distances) const override {
    const auto near = pattern_.near(block);
    for_lanes(
        block, distances,
        [&](const Doubles& x, const Doubles& y) { return pattern_.plan(x, y, near); },
        [&](const Point<Doubles>& p, const auto& plan) { return pattern_.at(plan, p.z); });
  }

 private:
  Pattern pattern_;
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

// Bits of the points for whose distances the comparison holds.
std::uint64_t where(const BlockDistances& distances, auto&& holds) {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < kBlockPoints; k += kDoubleLanes)
    bits |= bits_of(holds(load<Doubles>(&distances[k]))) << k;
  return bits;
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

void DistanceFunction::operator()(const PointBlock& block, BlockDistances& distances) const {
  implementation_->at(block, distances);
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

std::uint64_t ShapeSupport::contains_block(const PointBlock& block) const {
  BlockDistances distances;
  distance_(block, distances);
  return where(distances, [](const Doubles& d) { return d <= 0.0; });
}

BlockStates ShapeSupport::classify_block(const PointBlock& centers, const Vec3& half) const {
  BlockDistances distances;
  distance_(centers, distances);
  const double radius = glm::length(half);
  return {.inside = where(distances, [&](const Doubles& d) { return d < -radius; }),
          .outside = where(distances, [&](const Doubles& d) { return d > radius; })};
}

}  // namespace talus
