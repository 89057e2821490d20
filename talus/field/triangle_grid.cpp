#include "talus/field/triangle_grid.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace talus {

Int3 CellGrid::cell_of(const Vec3& p) const {
  return glm::clamp(Int3(glm::floor((p - origin) / cell)), Int3(0), size - 1);
}

TriangleGrid::TriangleGrid(const CellGrid& cells, std::span<const Vec3> vertices,
                           std::span<const Corners> triangles)
    : vertices_(vertices.begin(), vertices.end()), triangles_(triangles.begin(), triangles.end()) {
  for (const Corners& t : triangles_) {
    const Vec3& a = vertices_[t[0]];
    normals_.push_back(glm::cross(vertices_[t[1]] - a, vertices_[t[2]] - a));
  }
  list(cells);
}

// A cell lists the triangles whose box and plane meet it, both a little widened so that a triangle
// on the border of two cells is in both.
void TriangleGrid::list(const CellGrid& cells) {
  constexpr double kMargin = 1e-6;
  const auto plane_meets = [&](std::size_t t, const Int3& c) {
    const Vec3 n = glm::abs(normals_[t]);
    const double extent = 0.5 * cells.cell * (n.x + n.y + n.z) * (1 + kMargin);
    return std::abs(glm::dot(normals_[t], cells.middle(c) - vertices_[triangles_[t][0]])) <= extent;
  };
  const auto for_each_entry = [&](auto&& use) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Box3 box;
      for (const std::uint32_t v : triangles_[t]) box.include(vertices_[v]);
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

// Whether the line passes to the left of the edge a b. The ends are taken in order of index, so
// that both triangles of an edge see numbers that differ in sign only.
bool TriangleGrid::passes_left(const Vec3& from, const Vec3& to, std::uint32_t a,
                               std::uint32_t b) const {
  const bool forward = a < b;
  const Vec3 u = vertices_[forward ? a : b] - from, v = vertices_[forward ? b : a] - from;
  return (glm::dot(to - from, glm::cross(u, v)) >= 0) == forward;
}

int TriangleGrid::crossings(std::span<const std::uint32_t> listed, const Vec3& from,
                            const Vec3& to) const {
  int sum = 0;
  for (const std::uint32_t t : listed) {
    const Corners& c = triangles_[t];
    const Vec3& corner = vertices_[c[0]];
    const bool from_front = glm::dot(normals_[t], from - corner) >= 0;
    const bool to_front = glm::dot(normals_[t], to - corner) >= 0;
    if (from_front == to_front) continue;
    const bool left = passes_left(from, to, c[0], c[1]);
    if (passes_left(from, to, c[1], c[2]) == left && passes_left(from, to, c[2], c[0]) == left)
      sum += from_front ? 1 : -1;
  }
  return sum;
}

}  // namespace talus
