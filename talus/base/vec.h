// Vectors and axis-aligned boxes. World positions are double, mesh-local positions float.
#pragma once

#include <algorithm>
#include <concepts>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace talus {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec3f = glm::vec3;
using Int3 = glm::ivec3;
using Triangle = glm::uvec3;
using Quat = glm::quat;

// a / b rounded down; b > 0.
template <std::signed_integral T>
constexpr T floor_div(T a, T b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

// Closed axis-aligned box; the default is empty (min above max) and grows by `include`.
struct Box3 {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  Vec3 size() const { return max - min; }
  Vec3 center() const { return 0.5 * (min + max); }
  double longest_side() const {
    const Vec3 s = size();
    return std::max({s.x, s.y, s.z});
  }
  bool contains(const Vec3& p) const {
    return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y &&
           p.z <= max.z;
  }
  void include(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void include(const Box3& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  Box3 expanded(double margin) const { return {min - margin, max + margin}; }
};

// Closed axis-aligned rectangle of the plan.
struct Box2 {
  Vec2 min{0};
  Vec2 max{0};

  Vec2 size() const { return max - min; }
  bool operator==(const Box2&) const = default;
};

}  // namespace talus
