// Scenes as plain meshes, every stone written out.
#pragma once

#include <filesystem>

#include "talus/base/job.h"
#include "talus/io/scene_view.h"

namespace talus {

// Binary little-endian PLY in world coordinates, z up: x, y, z as double, nx, ny, nz as float;
// ground, water, then stones in the table's order. With ground that has shares there are red,
// green, blue (sRGB, the materials' colors blended) and a property for the share of each material,
// named like it, in 255ths; stones are of rocks then. Throws `Error` (job) if it cannot be written,
// or for more than 2^31 - 1 vertices, the most a face can name.
void write_ply(const std::filesystem::path& path, const SceneView& scene, Job* job = nullptr);

// OBJ with the objects `ground`, `water` and `stones/<k>/<i>` for instance i of prototype k, and
// normals. Ground with shares has colors behind its positions (sRGB, 0 to 1). World (x, y, z) is
// written as (x, z, -y), y up, which `read_mesh` turns back. Coordinates are rounded to a
// hundred-millionth of the scene's longest side. Throws `Error` (job) if it cannot be written.
void write_obj(const std::filesystem::path& path, const SceneView& scene, Job* job = nullptr);

}  // namespace talus
