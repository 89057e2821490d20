#include "talus/field/swept_tube.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "talus/mesh/polygon.h"

namespace talus {
namespace {

using Section = std::vector<Vec3f>;  // of the solid, in a plane

// Squared sine between planes that count as parallel, also of a path that turns back on itself.
constexpr double kParallel = 1e-6;
constexpr std::uint32_t kCapCornersMax = 1000;  // that `triangulate` cuts into ears

Vec3 point_of(const TubeRing& ring, const Vec2& place) {
  return ring.at + place.x * glm::cross(ring.along, ring.up) + place.y * ring.up;
}

// How far from a ring's center, within its plane, the plane of the next one passes it.
double room_before(const TubeRing& ring, const TubeRing& next) {
  const double sine = glm::length(glm::cross(ring.along, next.along));
  const double way = glm::dot(next.at - ring.at, next.along);
  return sine > 0 ? way / sine : std::numeric_limits<double>::infinity();
}

// The points of a ring, those that the plane of a ring beside it has passed moved back to that
// plane, within their own; `side` is 1 for the next ring, -1 for the one before.
Section drawn_in(const TubeRing& ring, const TubeRing& beside, double side) {
  const Vec3 toward = beside.along - glm::dot(beside.along, ring.along) * ring.along;
  const double squared = glm::dot(toward, toward);
  Section section;
  for (const Vec2& place : ring.outline) {
    Vec3 p = point_of(ring, place);
    const double passed = side * glm::dot(p - beside.at, beside.along);
    if (passed > 0 && squared > kParallel) p -= side * passed / squared * toward;
    section.emplace_back(p);
  }
  return section;
}

Section shifted(const TubeRing& ring, double along) {
  Section section;
  for (const Vec2& place : ring.outline)
    section.emplace_back(point_of(ring, place) + along * ring.along);
  return section;
}

// The level end of a tube: its own outline's triangles, or those of the other side. Of an outline
// with many points evenly chosen ones are triangulated, what is between two of them is a fan.
void close(const TubeRing& ring, std::uint32_t first, bool forward, TriangleMesh& mesh) {
  const auto n = static_cast<std::uint32_t>(ring.outline.size());
  const std::uint32_t stride = (n + kCapCornersMax - 1) / kCapCornersMax;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> corners;
  for (const Vec2& place : ring.outline) points.push_back(point_of(ring, place));
  for (std::uint32_t k = 0; k < n; k += stride) corners.push_back(k);
  std::vector<Triangle> triangles = triangulate(corners, points);
  for (const std::uint32_t corner : corners)
    for (std::uint32_t k = corner + 1; k < std::min(corner + stride, n); ++k)
      triangles.emplace_back(corner, k, (k + 1) % n);
  for (const Triangle& t : triangles)
    mesh.triangles.push_back(first + (forward ? Triangle(t.x, t.z, t.y) : t));
}

// The surface from each section to the next.
TriangleMesh join(const std::vector<Section>& sections, bool loop) {
  TriangleMesh mesh;
  for (const Section& section : sections)
    mesh.positions.insert(mesh.positions.end(), section.begin(), section.end());
  const auto n = static_cast<std::uint32_t>(sections.front().size());
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t here = 0; here + (loop ? 0 : n) < vertices; here += n) {
    const std::uint32_t there = (here + n) % vertices;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t next = (k + 1) % n;
      mesh.triangles.emplace_back(here + k, there + k, here + next);
      mesh.triangles.emplace_back(here + next, there + k, there + next);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh swept_tube(std::span<const TubeRing> rings, bool loop) {
  const std::size_t count = rings.size();
  // As a ring looks from before and from behind; where that differs, a level strip is between.
  std::vector<Section> sections;
  for (std::size_t i = 0; i < count; ++i) {
    const bool first = i == 0 && !loop, last = i + 1 == count && !loop;
    if (!first) sections.push_back(drawn_in(rings[i], rings[(i + count - 1) % count], -1));
    if (last) continue;
    Section leaving = drawn_in(rings[i], rings[(i + 1) % count], 1);
    if (first || sections.back() != leaving) sections.push_back(std::move(leaving));
  }
  TriangleMesh mesh = join(sections, loop);
  if (loop) return mesh;
  const auto around = static_cast<std::uint32_t>(rings.front().outline.size());
  close(rings.front(), 0, false, mesh);
  close(rings.back(), static_cast<std::uint32_t>(mesh.positions.size()) - around, true, mesh);
  return mesh;
}

std::vector<TriangleMesh> slabs_in_bends(std::span<const TubeRing> rings, bool loop,
                                         double half_thickness) {
  const std::size_t count = rings.size();
  const auto ring = [&](std::size_t k) -> const TubeRing& { return rings[k % count]; };
  const auto room = [&](std::size_t k) { return room_before(ring(k), ring(k + 1)); };
  std::vector<TriangleMesh> slabs;
  for (std::size_t i = loop ? 0 : 1; i + (loop ? 0 : 2) < count; ++i) {
    const bool tightest = room(i) < room(i + count - 1) && room(i) <= room(i + 1);
    if (!tightest || drawn_in(rings[i], ring(i + 1), 1) == shifted(rings[i], 0)) continue;
    const auto around = static_cast<std::uint32_t>(rings[i].outline.size());
    slabs.push_back(
        join({shifted(rings[i], -half_thickness), shifted(rings[i], half_thickness)}, false));
    close(rings[i], 0, false, slabs.back());
    close(rings[i], around, true, slabs.back());
  }
  return slabs;
}

}  // namespace talus
