#include "talus/field/winding_number.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace talus {
namespace {

constexpr std::uint32_t kLeafTriangles = 8;
// A node counts as one dipole beyond this many radii.
constexpr double kFarRadii = 2.5;

// Solid angle of a triangle over 4 pi ([VanOosterom1983]).
double triangle_winding(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(numerator, denominator) / (2 * std::numbers::pi);
}

Vec3 middle(const std::array<Vec3, 3>& t) { return (t[0] + t[1] + t[2]) / 3.0; }

}  // namespace

WindingNumber::WindingNumber(std::span<const std::array<Vec3, 3>> triangles)
    : triangles_(triangles.begin(), triangles.end()) {
  nodes_.reserve(2 * triangles_.size() / kLeafTriangles + 2);
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

// Splits at the median along the longest side, ties by position in all three coordinates.
void WindingNumber::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  summarize(nodes_[node], begin, end);
  if (end - begin <= kLeafTriangles) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  Box3 box;
  for (std::uint32_t i = begin; i < end; ++i) box.include(middle(triangles_[i]));
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto key = [axis](const std::array<Vec3, 3>& t) {
    const Vec3 m = middle(t);
    return std::array{m[axis], m[(axis + 1) % 3], m[(axis + 2) % 3]};
  };
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = first;
  nodes_.resize(nodes_.size() + 2);
  build(first, begin, half);
  build(first + 1, half, end);
}

void WindingNumber::summarize(Node& node, std::uint32_t begin, std::uint32_t end) const {
  Vec3 weighted(0);
  double total = 0;
  node.area_normal = Vec3(0);
  for (std::uint32_t i = begin; i < end; ++i) {
    const auto& t = triangles_[i];
    const Vec3 area_normal = 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = glm::length(area_normal);
    node.area_normal += area_normal;
    weighted += area * middle(t);
    total += area;
  }
  node.center = total > 0 ? weighted / total : middle(triangles_[begin]);
  for (std::uint32_t i = begin; i < end; ++i)
    for (const Vec3& corner : triangles_[i])
      node.radius = std::max(node.radius, glm::length(corner - node.center));
}

double WindingNumber::at(const Vec3& p) const {
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  double sum = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    const Vec3 d = node.center - p;
    const double distance2 = glm::dot(d, d);
    if (distance2 > kFarRadii * kFarRadii * node.radius * node.radius) {
      sum +=
          glm::dot(node.area_normal, d) / (4 * std::numbers::pi * distance2 * std::sqrt(distance2));
    } else if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        sum += triangle_winding(triangles_[i], p);
    } else {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
    }
  }
  return sum;
}

}  // namespace talus
