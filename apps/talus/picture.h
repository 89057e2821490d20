// Pictures of what was built.
#pragma once

#include "talus/base/image.h"
#include "talus/base/job.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/scene/build.h"

namespace talus::cli {

// Throws as `render_picture`.
Image draw(const BuildResult& result, Job* job);
Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job);

}  // namespace talus::cli
