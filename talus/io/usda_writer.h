// Scenes as USD text, for Houdini, Omniverse and other pipelines.
#pragma once

#include <cstdint>
#include <filesystem>

#include "talus/base/job.h"
#include "talus/io/scene_view.h"

namespace talus {

// Writes the scene as one layer of USD text, in metres, z up. Below the prim `scene`:
//
//   ground, water  meshes at their origins (double); ground with shares has the materials' colors,
//                  blended, as displayColor, and a vertex primvar in [0, 1] for the share of each
//                  material that it shows, named like it
//   stones         a PointInstancer at the center of the stones, positions relative to that;
//                  `prototypes/stone_<k>` for prototype k, its displayColor a tint drawn from
//                  `seed`
//   materials      a UsdPreviewSurface for each part, its color read from displayColor
//
// Orientations have half precision, as the schema wants them: within a twentieth of a degree. They
// and scales are left out where all are trivial. The file is a function of scene and seed alone.
// Throws `Error` (job) if it cannot be written.
void write_usda(const std::filesystem::path& path, const SceneView& scene, std::uint64_t seed = 1,
                Job* job = nullptr);

}  // namespace talus
