// Scenes that were written as GLB, read back.
#pragma once

#include <filesystem>
#include <optional>

#include "talus/mesh/instance_table.h"

namespace talus {

// The named parts of a scene; those that the file lacks are empty. World coordinates: metres, z up.
struct SceneFile {
  InstanceTable stones;
  TriangleMesh ground;  // with shares, as they were written
  Vec3 ground_origin{0};
  TriangleMesh water;
  Vec3 water_origin{0};
  std::optional<double> plane;  // as in `SceneView`
};

// A file of `write_glb`; nothing if another program wrote it, or if its stones are flattened and so
// no stones any more. Positions come back to float precision, or to the step
// that they were quantized by; stones of one shape in the file's order.
// Throws `Error` (input) naming the file and what would be right: it is missing, unreadable or
// malformed, has no triangles, a number that is not finite, or a stone that is mirrored.
std::optional<SceneFile> read_scene(const std::filesystem::path& path);

}  // namespace talus
