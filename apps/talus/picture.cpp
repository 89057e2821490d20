#include "apps/talus/picture.h"

#include <array>
#include <vector>

#include "talus/render/picture.h"
#include "talus/terrain/material.h"

namespace talus::cli {
namespace {

// How each material of the terrain looks, by its number.
std::vector<SurfaceLook> surface_looks() {
  using Pattern = SurfaceLook::Pattern;
  constexpr std::array<Pattern, kMaterialCount> kPatterns = {
      Pattern::rock,  Pattern::sand, Pattern::soil, Pattern::gravel,
      Pattern::plain, Pattern::ice,  Pattern::snow, Pattern::plain};
  std::vector<SurfaceLook> looks;
  for (const Pattern pattern : kPatterns) looks.push_back({.pattern = pattern});
  return looks;
}

}  // namespace

Image draw(const BuildResult& result, Job* job) {
  RenderScene scene{.stones = &result.stones, .ground = result.plane};
  if (const auto& terrain = result.terrain) {
    scene.surfaces = surface_looks();
    scene.stone_color = mean_color(scene.surfaces[static_cast<std::size_t>(Material::bedrock)]);
    scene.meshes = {{.mesh = &terrain->ground.mesh, .origin = terrain->ground.origin}};
    if (!terrain->water.triangles.empty())
      scene.water = {{.mesh = &terrain->water, .origin = terrain->ground.origin}};
  }
  return render_picture(scene, result.recipe.view, job);
}

Image draw(const TriangleMesh& mesh, const ViewParams& view, Job* job) {
  return render_picture({.meshes = {{.mesh = &mesh}}, .ground = bounds(mesh).min.z}, view, job);
}

}  // namespace talus::cli
