#include "talus/mesh/instance_table.h"

#include <fmt/format.h>

#include "talus/base/error.h"

namespace talus {

Box3 bounds(const InstanceTable& table) {
  Box3 box;
  for (const Instance& instance : table.instances)
    for (const Vec3f& p : table.prototypes[instance.prototype]->positions)
      box.include(world_from_local(instance, p));
  return box;
}

std::uint64_t triangle_count(const InstanceTable& table) {
  std::uint64_t count = 0;
  for (const Instance& instance : table.instances)
    count += table.prototypes[instance.prototype]->triangles.size();
  return count;
}

TriangleMesh flatten(const InstanceTable& table, const Vec3& origin) {
  std::uint64_t vertices = 0;
  for (const Instance& instance : table.instances)
    vertices += table.prototypes[instance.prototype]->positions.size();
  if (vertices > std::numeric_limits<std::uint32_t>::max())
    throw job_error(
        fmt::format("{} vertices are too many for one mesh; write instances", vertices));

  TriangleMesh out;
  out.positions.reserve(vertices);
  out.normals.reserve(vertices);
  out.triangles.reserve(triangle_count(table));
  for (const Instance& instance : table.instances) {
    const TriangleMesh& prototype = *table.prototypes[instance.prototype];
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const Vec3f& p : prototype.positions)
      out.positions.emplace_back(world_from_local(instance, p) - origin);
    for (const Vec3f& n : prototype.normals) out.normals.push_back(instance.rotation * n);
    for (const Triangle& t : prototype.triangles) out.triangles.push_back(t + first);
  }
  return out;
}

}  // namespace talus
