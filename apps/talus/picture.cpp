#include "apps/talus/picture.h"

#include "talus/render/picture.h"

namespace talus::cli {
namespace {

RenderParams render_params(const ViewParams& view) {
  return {.width = view.width,
          .height = view.height,
          .azimuth_deg = view.azimuth_deg,
          .elevation_deg = view.elevation_deg,
          .field_of_view_deg = view.field_of_view_deg,
          .zoom = view.zoom,
          .sun_azimuth_deg = view.sun_azimuth_deg,
          .sun_elevation_deg = view.sun_elevation_deg};
}

}  // namespace

Image draw(const BuildResult& result, Job* job) {
  RenderScene scene{.stones = &result.stones};
  if (result.recipe.view.ground) scene.ground = result.ground;
  return render_picture(scene, render_params(result.recipe.view), job);
}

Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job) {
  RenderScene scene{.meshes = {{.mesh = &mesh}}};
  if (view.ground) scene.ground = bounds(mesh).min.z;
  return render_picture(scene, render_params(view), job);
}

}  // namespace talus::cli
