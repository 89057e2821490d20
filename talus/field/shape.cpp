#include "talus/field/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace talus {
namespace {

constexpr double kEndless = 4e9;  // farther than any place may be

// The square root is exactly rounded everywhere, which std::hypot is not.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

double distance_to(const Sphere& s, const Vec3& p) { return glm::length(p - s.center) - s.radius; }

double distance_to(const Box& b, const Vec3& p) {
  const Vec3 q = glm::abs(p - b.center) - (0.5 * b.size - b.rounding);
  return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - b.rounding;
}

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

  double operator()(const Vec3& p) const {
    const Vec3 q = p - capsule_.from;
    const double along = glm::dot(q, axis_) / length_;
    const double across = std::sqrt(std::max(0.0, glm::dot(q, q) - along * along));
    const double on_tangent = along * cosine_ - across * sine_;
    if (on_tangent < 0) return length(along, across) - capsule_.from_radius;
    if (on_tangent > length_ * cosine_) return length(along - length_, across) - capsule_.to_radius;
    return along * sine_ + across * cosine_ - capsule_.from_radius;
  }

 private:
  Capsule capsule_;
  Vec3 axis_;
  double length_, sine_, cosine_;
};

double distance_to(const Cylinder& c, const Vec3& p) {
  const double across = length(p.x - c.base.x, p.y - c.base.y) - c.radius;
  const double along = std::abs(p.z - c.base.z - 0.5 * c.height) - 0.5 * c.height;
  return length(std::max(across, 0.0), std::max(along, 0.0)) +
         std::min(std::max(across, along), 0.0);
}

double distance_to(const HalfSpace& h, const Vec3& p) {
  return glm::dot(p - h.point, h.normal) / glm::length(h.normal);
}

// Polynomial smooth minimum: 1-Lipschitz if both arguments are, at most `blend` / 4 below them.
double smooth_min(double a, double b, double blend) {
  if (blend <= 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

class CombinationDistance {
 public:
  explicit CombinationDistance(const Combination& c) : rule_(c.rule), blend_(c.blend) {
    for (const Shape& part : c.parts) parts_.push_back(distance_function(part));
  }

  double operator()(const Vec3& p) const {
    double d = parts_.front()(p);
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      const double part = parts_[i](p);
      switch (rule_) {
        case Combination::Rule::join:
          d = smooth_min(d, part, blend_);
          break;
        case Combination::Rule::subtract:
          d = -smooth_min(-d, part, blend_);
          break;
        case Combination::Rule::intersect:
          d = -smooth_min(-d, -part, blend_);
          break;
      }
    }
    return d;
  }

 private:
  Combination::Rule rule_;
  double blend_;
  std::vector<DistanceFunction> parts_;
};

struct MakeDistance {
  DistanceFunction operator()(const auto& shape) const {
    return [shape](const Vec3& p) { return distance_to(shape, p); };
  }
  DistanceFunction operator()(const Capsule& c) const {
    const double longer = c.from_radius - c.to_radius;
    if (glm::length(c.to - c.from) > std::abs(longer)) return CapsuleDistance(c);
    return (*this)(longer > 0 ? Sphere{c.from, c.from_radius} : Sphere{c.to, c.to_radius});
  }
  DistanceFunction operator()(const Combination& c) const { return CombinationDistance(c); }
};

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

void validate_shape(const Shape& shape) {
  std::visit(
      [](const auto& s) {
        using T = std::remove_cvref_t<decltype(s)>;
        if constexpr (std::is_same_v<T, Combination>) {
          if (s.parts.empty())
            throw usage_error("support.parts is empty; a combination needs at least one shape");
          detail::check_number("support.blend", Field{.unit = "m", .min = 0, .max = 1e9}, s.blend);
          for (const Shape& part : s.parts) validate_shape(part);
        } else {
          validate(s, fmt::format("support.{}", T::kName));
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
}

}  // namespace

DistanceFunction distance_function(const Shape& shape) { return std::visit(MakeDistance{}, shape); }

Box3 bounds(const Shape& shape) {
  const Box3 loose = loose_bounds(shape);
  if (!std::holds_alternative<Combination>(shape) || loose.empty()) return loose;
  // Blending and cutting leave the sum of the parts' boxes too large; find what is occupied.
  Box3 found;
  collect_occupied(distance_function(shape), loose, loose.longest_side() / 256, found);
  return found;
}

ShapeSupport::ShapeSupport(const Shape& shape) {
  validate_shape(shape);
  distance_ = distance_function(shape);
  bounds_ = talus::bounds(shape);
  if (bounds_.empty())
    throw usage_error("the support's shapes leave nothing: their combination is empty");
}

BoxState ShapeSupport::classify(const Box3& box) const { return classify_box(distance_, box); }

}  // namespace talus
