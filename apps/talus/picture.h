// Pictures of what was built or read.
#pragma once

#include <memory>
#include <vector>

#include "talus/base/image.h"
#include "talus/base/job.h"
#include "talus/io/scene_reader.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/render/render_scene.h"
#include "talus/scene/build.h"

namespace talus::cli {

// How each material of the terrain looks, by its number. Throws `Error` (input) naming the key for
// a picture that `read_image` refuses.
std::vector<SurfaceLook> read_looks(const SurfacesParams& surfaces);

// Throws as `render_picture`.
Image draw(const BuildResult& result, const std::vector<SurfaceLook>& looks, Job* job);
Image draw(const SceneFile& file, const std::vector<SurfaceLook>& looks, const ViewParams& view,
           Job* job);
Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job);

// Some of a set's stones, side by side; how they are seen unless told otherwise.
Image draw(const TileSet& tiles, const ViewParams& view, Job* job);
ViewParams specimens_view();

// A level cut through stones, and through two cubes of a tiling with its contacts. Throw `Error`
// (usage) for a height where there is nothing to cut.
Image draw_section(const InstanceTable& stones, double height, int width);
Image draw_section(const std::shared_ptr<const TileSet>& tiles, double height, int width);

}  // namespace talus::cli
