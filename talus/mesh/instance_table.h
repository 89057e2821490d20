// Many copies of few meshes, without copying a mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "talus/mesh/triangle_mesh.h"

namespace talus {

// What the maker of an instance calls it, so that it can be told to change it: of a pile's stone
// the pile, counted from 0, the cell of its seed and which of the cell's seeds.
struct InstanceName {
  Int3 cell{0};
  std::uint16_t seed = 0;
  std::uint16_t pile = 0;
};

// world = position + scale * (rotation * local).
struct Instance {
  Vec3 position{0};
  Quat rotation{1, 0, 0, 0};  // unit
  float scale = 1;
  std::uint32_t prototype = 0;
  InstanceName name;
};

// Every prototype is used by at least one instance; instances are sorted by prototype, so that
// those of one mesh are a contiguous run.
struct InstanceTable {
  std::vector<std::shared_ptr<const TriangleMesh>> prototypes;
  std::vector<Instance> instances;
};

inline Vec3 world_from_local(const Instance& instance, const Vec3f& local) {
  return instance.position + Vec3(instance.scale * (instance.rotation * local));
}

// Box around the instances' vertices.
Box3 bounds(const InstanceTable& table);
// Triangles drawn, each instance counted.
std::uint64_t triangle_count(const InstanceTable& table);
// All instances in one mesh, in the table's order; positions relative to `origin`. Throws `Error`
// (job) if more than 2^32 - 1 vertices come out.
TriangleMesh flatten(const InstanceTable& table, const Vec3& origin);

}  // namespace talus
