#include "talus/mesh/triangle_mesh.h"

#include <glm/geometric.hpp>

namespace talus {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3f& p : mesh.positions) box.include(Vec3(p));
  return box;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  // The flux of (x, 0, 0) through the surface.
  const float origin = mesh.positions.front().x;
  double six_volumes = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3f &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const Vec3 ab(b - a), ac(c - a);
    const Vec3f x(a.x - origin, b.x - origin, c.x - origin);
    six_volumes += (double{x.x} + x.y + x.z) * (ab.y * ac.z - ab.z * ac.y);
  }
  return six_volumes / 6;
}

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), Vec3f(0));
  for (const Triangle& t : mesh.triangles) {
    const Vec3f &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const Vec3f ab = b - a, bc = c - b, ca = a - c;
    // The same for each corner.
    const Vec3f doubled_area = glm::cross(ab, bc);
    const float ab2 = glm::dot(ab, ab), bc2 = glm::dot(bc, bc), ca2 = glm::dot(ca, ca);
    if (ab2 * bc2 > 0) mesh.normals[t.y] += doubled_area / (ab2 * bc2);
    if (bc2 * ca2 > 0) mesh.normals[t.z] += doubled_area / (bc2 * ca2);
    if (ca2 * ab2 > 0) mesh.normals[t.x] += doubled_area / (ca2 * ab2);
  }
  for (Vec3f& n : mesh.normals) {
    const float length = glm::length(n);
    n = length > 0 ? n / length : Vec3f(0, 0, 1);
  }
}

}  // namespace talus
