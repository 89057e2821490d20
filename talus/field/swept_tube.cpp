#include "talus/field/swept_tube.h"

#include <glm/geometric.hpp>

namespace talus {
namespace {

// How much of the way to the next ring's plane a point keeps, of its center's.
constexpr double kKept = 0.05;

// Moves a point of a ring within its plane to where the plane of a ring beside it has not come;
// `side` is 1 for the next ring, -1 for the one before.
void keep_off(Vec3& p, const TubeRing& ring, const TubeRing& beside, double side) {
  const double center = side * glm::dot(ring.at - beside.at, beside.along);
  const double excess = side * glm::dot(p - beside.at, beside.along) - kKept * center;
  if (excess <= 0) return;
  const Vec3 toward = beside.along - glm::dot(beside.along, ring.along) * ring.along;
  const double squared = glm::dot(toward, toward);
  if (squared > 0) p -= side * excess / squared * toward;
}

}  // namespace

TriangleMesh swept_tube(std::span<const TubeRing> rings, bool loop) {
  const auto ring_count = static_cast<std::uint32_t>(rings.size());
  const auto around = static_cast<std::uint32_t>(rings.front().outline.size());
  TriangleMesh mesh;
  mesh.positions.reserve(std::size_t{ring_count} * around);
  for (std::uint32_t i = 0; i < ring_count; ++i) {
    const TubeRing& ring = rings[i];
    const Vec3 right = glm::cross(ring.along, ring.up);
    for (const Vec2& point : ring.outline) {
      Vec3 p = ring.at + point.x * right + point.y * ring.up;
      if (i + 1 < ring_count || loop) keep_off(p, ring, rings[(i + 1) % ring_count], 1);
      if (i > 0 || loop) keep_off(p, ring, rings[(i + ring_count - 1) % ring_count], -1);
      mesh.positions.emplace_back(p);
    }
  }

  // The side, two triangles from point to point and from ring to ring.
  const std::uint32_t steps = loop ? ring_count : ring_count - 1;
  mesh.triangles.reserve(2 * std::size_t{steps} * around);
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint32_t here = i * around, there = (i + 1) % ring_count * around;
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around;
      mesh.triangles.emplace_back(here + k, there + k, here + next);
      mesh.triangles.emplace_back(here + next, there + k, there + next);
    }
  }
  // The ends, as fans: where an outline is not convex they overlap themselves and cancel out.
  if (!loop) {
    const std::uint32_t last = (ring_count - 1) * around;
    for (std::uint32_t k = 1; k + 1 < around; ++k) {
      mesh.triangles.emplace_back(0, k, k + 1);
      mesh.triangles.emplace_back(last, last + k + 1, last + k);
    }
  }
  return mesh;
}

}  // namespace talus
