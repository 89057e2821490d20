#include "apps/talus/picture.h"

#include "talus/render/picture.h"

namespace talus::cli {
Image draw(const BuildResult& result, Job* job) {
  return render_picture({.stones = &result.stones, .ground = result.ground}, result.recipe.view,
                        job);
}

Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job) {
  return render_picture({.meshes = {{.mesh = &mesh}}, .ground = bounds(mesh).min.z}, view, job);
}

}  // namespace talus::cli
