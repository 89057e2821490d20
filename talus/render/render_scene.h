// What a picture shows.
#pragma once

#include <optional>
#include <vector>

#include "talus/base/vec.h"
#include "talus/mesh/instance_table.h"
#include "talus/mesh/triangle_mesh.h"

namespace talus {

// A mesh drawn in one color, from both sides; its positions are relative to `origin`.
struct RenderMesh {
  const TriangleMesh* mesh = nullptr;
  Vec3 origin{0};
  Vec3f color{0.42f, 0.39f, 0.35f};  // share of light reflected: linear red, green, blue
};

// Metres, z up. What it points to must outlive its use. Meshes without normals get smooth ones.
struct RenderScene {
  const InstanceTable* stones = nullptr;
  std::vector<RenderMesh> meshes;
  std::optional<double> ground;  // height of an endless plane of earth and gravel
};

struct Ball {
  Vec3 center{0};
  double radius = 0;
};

// Balls that hold everything but the ground: one per stone in the table's order, then one for each
// corner of a mesh's box. A scene without both counts as one ball a metre wide on its ground.
// Throws `Error` (usage) if a position is not finite.
std::vector<Ball> bounding_balls(const RenderScene& scene);

Box3 bounds(const std::vector<Ball>& balls);
inline Box3 bounds(const RenderScene& scene) { return bounds(bounding_balls(scene)); }

}  // namespace talus
