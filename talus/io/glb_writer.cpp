#include "talus/io/glb_writer.h"

#include "talus/io/glb_file.h"
#include "talus/io/glb_stones.h"
#include "talus/io/glb_surface.h"

namespace talus {
namespace {

const char* name_of(InstanceMode mode) {
  switch (mode) {
    case InstanceMode::gpu:
      return "gpu";
    case InstanceMode::nodes:
      return "nodes";
    case InstanceMode::flattened:
      return "flattened";
  }
  return "";
}

}  // namespace

GlbStats write_glb(const std::filesystem::path& path, const SceneView& scene,
                   const GlbParams& params, Job* job) {
  const InstanceTable empty;
  GlbFile file;
  GlbStats stats;
  GlbSurfaces surfaces(scene);
  surfaces.add_to(file, stats);
  GlbStones stones(scene.stones ? *scene.stones : empty, params, job);
  stones.add_to(file, stats);
  nlohmann::json& extras = file.at("scenes", 0)["extras"];
  extras["instances"] = name_of(params.instances);
  if (scene.plane) extras["plane"] = *scene.plane;
  stats.nodes = file.size("nodes");
  stats.meshes = file.size("meshes");
  stats.bytes = file.write(path, job);
  return stats;
}

}  // namespace talus
