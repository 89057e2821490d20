// The named parts of a scene, as the writers take them.
#pragma once

#include "talus/mesh/instance_table.h"

namespace talus {

// Refers to its parts, which must outlive it; null is an absent part. World coordinates: metres, z
// up.
struct SceneView {
  const InstanceTable* stones = nullptr;
};

}  // namespace talus
