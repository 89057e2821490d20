// The named parts of a scene, as the writers take them.
#pragma once

#include <optional>

#include "talus/mesh/instance_table.h"

namespace talus {

// A mesh whose positions are relative to `origin`; null is an absent part.
struct PlacedMesh {
  const TriangleMesh* mesh = nullptr;
  Vec3 origin{0};
};

// Refers to its parts, which must outlive it; null is an absent part. World coordinates: metres, z
// up.
struct SceneView {
  const InstanceTable* stones = nullptr;
  PlacedMesh ground;  // shares are those of the table of materials, in its order
  PlacedMesh water;
  std::optional<double> plane;  // height of the plane that stones without ground stand on
};

}  // namespace talus
