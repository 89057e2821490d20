#include "talus/render/coarse_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace talus {

TriangleMesh coarse_mesh(const TriangleMesh& mesh, int cells) {
  if (mesh.positions.empty()) return {};
  constexpr std::uint32_t kNone = 0xffffffffu;
  const Box3 box = bounds(mesh);
  const double cell = std::max(box.longest_side(), 1e-30) / cells;
  const Int3 size = glm::min(Int3(box.size() / cell) + 1, Int3(cells));
  const auto nx = static_cast<std::size_t>(size.x), ny = static_cast<std::size_t>(size.y);
  std::vector<std::uint32_t> vertex_of_cell(nx * ny * static_cast<std::size_t>(size.z), kNone);
  std::vector<std::uint32_t> coarse_of_fine(mesh.positions.size());
  const bool shaded = !mesh.normals.empty();

  // Vertices are summed cell by cell, in their order.
  TriangleMesh coarse;
  std::vector<float> counts;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Int3 at = glm::min(Int3((Vec3(mesh.positions[i]) - box.min) / cell), size - 1);
    std::uint32_t& vertex =
        vertex_of_cell[static_cast<std::size_t>(at.x) +
                       nx * (static_cast<std::size_t>(at.y) + ny * static_cast<std::size_t>(at.z))];
    if (vertex == kNone) {
      vertex = static_cast<std::uint32_t>(counts.size());
      counts.push_back(0);
      coarse.positions.emplace_back(0);
      coarse.normals.emplace_back(0);
    }
    coarse_of_fine[i] = vertex;
    counts[vertex] += 1;
    coarse.positions[vertex] += mesh.positions[i];
    if (shaded) coarse.normals[vertex] += mesh.normals[i];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    coarse.positions[i] /= counts[i];
    const float length = glm::length(coarse.normals[i]);
    coarse.normals[i] = length > 1e-6f ? coarse.normals[i] / length : Vec3f(0, 0, 1);
  }

  for (const Triangle& t : mesh.triangles) {
    const Triangle c(coarse_of_fine[t.x], coarse_of_fine[t.y], coarse_of_fine[t.z]);
    if (c.x != c.y && c.y != c.z && c.z != c.x) coarse.triangles.push_back(c);
  }
  return coarse;
}

}  // namespace talus
