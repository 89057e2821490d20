#include "talus/mesh/polygon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace talus {
namespace {

struct Corner {
  std::uint32_t vertex;
  double u, v;  // in the polygon's plane, counter-clockwise
};

// Twice the signed area of a triangle in the plane.
double area(const Corner& a, const Corner& b, const Corner& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// The polygon along the axis its area vector (Newell) is longest in, turned counter-clockwise.
std::vector<Corner> flattened(std::span<const std::uint32_t> corners,
                              std::span<const Vec3> positions) {
  Vec3 normal(0);
  const Vec3 origin = positions[corners[0]];
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(positions[corners[i]] - origin,
                         positions[corners[(i + 1) % corners.size()]] - origin);
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double sign = normal[axis] < 0 ? -1 : 1;

  std::vector<Corner> out;
  out.reserve(corners.size());
  for (const std::uint32_t vertex : corners) {
    const Vec3 p = positions[vertex] - origin;
    out.push_back({vertex, sign * p[(axis + 1) % 3], p[(axis + 2) % 3]});
  }
  return out;
}

bool is_convex(const std::vector<Corner>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    if (area(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) < 0) return false;
  return true;
}

// Whether the triangle at a convex corner holds no other corner of the polygon.
bool is_ear(const std::vector<Corner>& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  const Corner &a = polygon[(i + n - 1) % n], &b = polygon[i], &c = polygon[(i + 1) % n];
  if (area(a, b, c) <= 0) return false;
  for (const Corner& p : polygon) {
    if (p.vertex == a.vertex || p.vertex == b.vertex || p.vertex == c.vertex) continue;
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
  }
  return true;
}

// Ears are looked for in large polygons for too long; past this they are cut as if convex.
constexpr std::size_t kEarCornersMax = 1000;

}  // namespace

std::vector<Triangle> triangulate(std::span<const std::uint32_t> corners,
                                  std::span<const Vec3> positions) {
  std::vector<Triangle> triangles;
  if (corners.size() == 3) {
    triangles.emplace_back(corners[0], corners[1], corners[2]);
    return triangles;
  }
  // Cut ears off while there are any; what is left is convex, or crosses itself and has no good
  // cut.
  std::vector<Corner> polygon = flattened(corners, positions);
  while (polygon.size() > 3 && polygon.size() <= kEarCornersMax && !is_convex(polygon)) {
    std::size_t ear = 0;
    while (ear < polygon.size() && !is_ear(polygon, ear)) ++ear;
    if (ear == polygon.size()) break;
    const std::size_t n = polygon.size();
    triangles.emplace_back(polygon[(ear + n - 1) % n].vertex, polygon[ear].vertex,
                           polygon[(ear + 1) % n].vertex);
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  for (std::size_t i = 2; i < polygon.size(); ++i)
    triangles.emplace_back(polygon[0].vertex, polygon[i - 1].vertex, polygon[i].vertex);
  return triangles;
}

}  // namespace talus
