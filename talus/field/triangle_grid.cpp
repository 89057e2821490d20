#include "talus/field/triangle_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "talus/field/distance_lanes.h"

namespace talus {
namespace {

using lanes::magnitude;

// Sign of a value that is exactly zero in special positions, where the values it takes after nudges
// along two fixed directions decide.
bool positive(double value, auto&& nudged) {
  constexpr Vec3 kNudge(0.5377, -0.8339, 0.1259), kSecondNudge(-0.3187, 0.2624, 0.9107);
  if (value != 0) return value > 0;
  const double first = nudged(kNudge);
  return first != 0 ? first > 0 : nudged(kSecondNudge) > 0;
}

}  // namespace

Int3 CellGrid::cell_of(const Vec3& p) const {
  return glm::clamp(Int3(glm::floor((p - origin) / cell)), Int3(0), size - 1);
}

TriangleGrid::TriangleGrid(const CellGrid& cells, std::span<const Vec3> vertices,
                           std::span<const Triangle> triangles, Job* job)
    : vertices_(vertices.begin(), vertices.end()), triangles_(triangles.begin(), triangles.end()) {
  for (const Triangle& t : triangles_) {
    const Vec3& a = vertices_[t.x];
    normals_.push_back(glm::cross(vertices_[t.y] - a, vertices_[t.z] - a));
  }
  list(cells, job);
}

// A cell lists the triangles whose box and plane meet it, both a little widened so that a triangle
// on the border of two cells is in both.
void TriangleGrid::list(const CellGrid& cells, Job* job) {
  constexpr double kMargin = 1e-6;
  const auto plane_meets = [&](std::size_t t, const Int3& c) {
    const Vec3 n = glm::abs(normals_[t]);
    const double extent = 0.5 * cells.cell * (n.x + n.y + n.z) * (1 + kMargin);
    return std::abs(glm::dot(normals_[t], cells.middle(c) - vertices_[triangles_[t].x])) <= extent;
  };
  const auto for_each_entry = [&](auto&& use) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (t % 4096 == 0) check_cancelled(job);
      Box3 box;
      for (int k = 0; k < 3; ++k) box.include(vertices_[triangles_[t][k]]);
      box = box.expanded(kMargin * cells.cell);
      const Int3 first = cells.cell_of(box.min), last = cells.cell_of(box.max);
      for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
          for (int x = first.x; x <= last.x; ++x)
            if (plane_meets(t, {x, y, z})) use(cells.index({x, y, z}), t);
    }
  };
  first_.assign(cells.count() + 1, 0);
  for_each_entry([&](std::size_t c, std::size_t) { ++first_[c + 1]; });
  for (std::size_t c = 0; c < cells.count(); ++c) first_[c + 1] += first_[c];
  lists_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_entry(
      [&](std::size_t c, std::size_t t) { lists_[next[c]++] = static_cast<std::uint32_t>(t); });
}

bool TriangleGrid::in_front(const Vec3& p, std::uint32_t triangle) const {
  const Vec3& normal = normals_[triangle];
  return positive(glm::dot(normal, p - vertices_[triangles_[triangle].x]),
                  [&](const Vec3& nudge) { return glm::dot(normal, nudge); });
}

// Whether the line passes to the left of the edge a b. The ends are taken in order of index, so
// that both triangles of an edge see numbers that differ in sign only. With the line moved by e,
// the determinant |d u v| changes by |d e u - v|.
bool TriangleGrid::passes_left(const Vec3& from, const Vec3& to, std::uint32_t a,
                               std::uint32_t b) const {
  const bool forward = a < b;
  const Vec3 u = vertices_[forward ? a : b] - from, v = vertices_[forward ? b : a] - from;
  const Vec3 d = to - from;
  return positive(glm::dot(d, glm::cross(u, v)), [&](const Vec3& nudge) {
           return glm::dot(d, glm::cross(nudge, u - v));
         }) == forward;
}

// Of a line whose ends lie on either side of the triangle's plane.
bool TriangleGrid::passes_through(const Vec3& from, const Vec3& to, std::uint32_t triangle) const {
  const Triangle& c = triangles_[triangle];
  const bool left = passes_left(from, to, c.x, c.y);
  return passes_left(from, to, c.y, c.z) == left && passes_left(from, to, c.z, c.x) == left;
}

int TriangleGrid::crossings(std::span<const std::uint32_t> listed, const Vec3& from,
                            const Vec3& to) const {
  int sum = 0;
  for (const std::uint32_t t : listed) {
    const bool from_front = in_front(from, t);
    if (in_front(to, t) == from_front) continue;
    if (passes_through(from, to, t)) sum += from_front ? 1 : -1;
  }
  return sum;
}

void TriangleGrid::add_crossings(std::span<const std::uint32_t> listed, const Vec3& from,
                                 std::span<const Vec3> to, std::span<double> sums) const {
  for (const std::uint32_t t : listed) {
    const bool from_front = in_front(from, t);
    for (std::size_t i = 0; i < to.size(); ++i)
      if (in_front(to[i], t) != from_front && passes_through(from, to[i], t))
        sums[i] += from_front ? 1 : -1;
  }
}

TriangleGrid::Touched TriangleGrid::touched(std::span<const std::uint32_t> listed,
                                            const PointBlock& centers, const Vec3& half) const {
  constexpr double kSlack = 1e-9;  // of rounding, in parts of what is compared
  std::array<std::array<Doubles, kBlockPoints / kDoubleLanes>, 3> places;
  for (int i = 0; i < kBlockPoints; ++i) {
    const Vec3 p = centers.point(i) - centers.first;
    for (int axis = 0; axis < 3; ++axis)
      places[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i / 4)][i % 4] = p[axis];
  }
  const Vec3 meeting = glm::max(half, 0.5 * (glm::abs(centers.step[0]) + glm::abs(centers.step[1]) +
                                             glm::abs(centers.step[2])));
  const Box3 around = centers.box_around(meeting);
  const Vec3 block_half = 0.5 * around.size(), middle = around.center() - centers.first;
  Touched all;
  for (const std::uint32_t t : listed) {
    Box3 box;
    for (int k = 0; k < 3; ++k) box.include(vertices_[triangles_[t][k]] - centers.first);
    const Vec3& normal = normals_[t];
    const Vec3 corner = vertices_[triangles_[t].x] - centers.first, steep = glm::abs(normal);
    const Vec3 slack = kSlack * (glm::abs(centers.first) + block_half + box.size());
    // Most are far from the whole block.
    const Vec3 apart = glm::max(box.min - middle, middle - box.max) - block_half - slack;
    if (std::max({apart.x, apart.y, apart.z}) > 0) continue;
    const double offset = std::abs(glm::dot(normal, middle - corner));
    if (offset > glm::dot(steep, block_half + slack)) continue;

    const double thin = glm::dot(steep, half + slack), thick = glm::dot(steep, meeting + slack);
    const Vec3 center = 0.5 * (box.min + box.max), size = 0.5 * box.size() + slack;
    for (std::size_t row = 0; row < places[0].size(); ++row) {
      const Doubles x = places[0][row], y = places[1][row], z = places[2][row];
      const Doubles across = magnitude(Doubles(
          (x - corner.x) * normal.x + (y - corner.y) * normal.y + (z - corner.z) * normal.z));
      const Doubles dx = magnitude(Doubles(x - center.x)) - size.x,
                    dy = magnitude(Doubles(y - center.y)) - size.y,
                    dz = magnitude(Doubles(z - center.z)) - size.z;
      const auto within = [&](const Vec3& reach, double thickness) {
        return bits_of((dx <= reach.x) & (dy <= reach.y) & (dz <= reach.z) & (across <= thickness));
      };
      all.boxes |= within(half, thin) << (4 * row);
      all.meeting |= within(meeting, thick) << (4 * row);
    }
  }
  return all;
}

}  // namespace talus
