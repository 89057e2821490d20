// Ground and water as parts of a GLB file.
#pragma once

#include <deque>

#include "talus/io/glb_file.h"
#include "talus/io/glb_writer.h"

namespace talus {

// Refers to the meshes and itself holds what is written: all must live until the file is written.
class GlbSurfaces {
 public:
  GlbSurfaces(const SceneView& scene) : scene_(scene) {}

  // Adds meshes, nodes and materials; counts what it adds.
  void add_to(GlbFile& file, GlbStats& stats);

 private:
  void add_surface(const char* name, const PlacedMesh& placed, const nlohmann::json& material,
                   GlbFile& file, GlbStats& stats);

  const SceneView& scene_;
  std::deque<TriangleMesh> computed_;  // normals of meshes that have none
};

}  // namespace talus
