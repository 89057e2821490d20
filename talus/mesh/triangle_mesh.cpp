#include "talus/mesh/triangle_mesh.h"

#include <array>
#include <glm/geometric.hpp>

namespace talus {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3f& p : mesh.positions) box.include(Vec3(p));
  return box;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  const Vec3 origin = bounds(mesh).center();
  double six_volumes = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = Vec3(mesh.positions[t.x]) - origin;
    const Vec3 b = Vec3(mesh.positions[t.y]) - origin;
    const Vec3 c = Vec3(mesh.positions[t.z]) - origin;
    six_volumes += glm::dot(a, glm::cross(b, c));
  }
  return six_volumes / 6;
}

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), Vec3f(0));
  for (const Triangle& t : mesh.triangles) {
    const std::array<Vec3f, 3> p = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3f u = p[(corner + 1) % 3] - p[corner];
      const Vec3f v = p[(corner + 2) % 3] - p[corner];
      const float weight = glm::dot(u, u) * glm::dot(v, v);
      if (weight > 0) mesh.normals[t[static_cast<int>(corner)]] += glm::cross(u, v) / weight;
    }
  }
  for (Vec3f& n : mesh.normals) {
    const float length = glm::length(n);
    n = length > 0 ? n / length : Vec3f(0, 0, 1);
  }
}

}  // namespace talus
