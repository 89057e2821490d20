#include "talus/mesh/polygon.h"

#include "talus/io/mesh_formats.h"

namespace talus {

void append_polygon(std::span<const std::uint32_t> corners, FileMesh& mesh) {
  if (corners.size() < 3) {
    ++mesh.dropped;
    return;
  }
  const std::vector<Triangle> triangles = triangulate(corners, mesh.positions);
  mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
}

}  // namespace talus
