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
};

// A file of `write_glb`, in any of its modes; nothing if another program wrote it. Positions come
// back to float precision; of each run of equal stones the order is kept. Throws `Error` (input) as
// `read_mesh` does.
std::optional<SceneFile> read_scene(const std::filesystem::path& path);

}  // namespace talus
