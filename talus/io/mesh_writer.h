// Scenes as plain meshes, every stone written out.
#pragma once

#include <filesystem>

#include "talus/base/job.h"
#include "talus/io/scene_view.h"

namespace talus {

// Binary little-endian PLY in world coordinates, z up: x, y, z as double, nx, ny, nz as float,
// triangles in the instance table's order. Throws `Error` (job) if it cannot be written, or for
// more than 2^31 - 1 vertices, the most a face can name.
void write_ply(const std::filesystem::path& path, const SceneView& scene, Job* job = nullptr);

// OBJ with an object `stones/<k>/<i>` for instance i of prototype k, and normals. World (x, y, z)
// is written as (x, z, -y), y up, which `read_mesh` turns back. Coordinates are rounded to a
// hundred-millionth of the scene's longest side. Throws `Error` (job) if it cannot be written.
void write_obj(const std::filesystem::path& path, const SceneView& scene, Job* job = nullptr);

}  // namespace talus
