// What a picture shows.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "talus/base/image.h"
#include "talus/base/vec.h"
#include "talus/mesh/instance_table.h"
#include "talus/mesh/triangle_mesh.h"

namespace talus {

// Photographs of a material, seamless at their edges; they need not be of one size. Those without
// pixels are left out: the surface is then flat, dull or of even height there.
struct SurfaceImages {
  Image albedo;     // sRGB; a fourth channel is the height
  Image normal;     // x right, y up the picture, z outward, 0 at 128; a fourth channel is roughness
  Image roughness;  // grey: 0 is a mirror
  Image height;     // grey: what is high shows first where materials meet
  double size = 2;  // metres that a picture covers
};

// How a material looks.
struct SurfaceLook {
  enum class Pattern { plain, rock, sand, soil, gravel, ice, snow };

  Pattern pattern = Pattern::plain;
  std::optional<Vec3f> color;  // share of light reflected, linear; else as usual for the pattern
  std::shared_ptr<const SurfaceImages> images;  // instead of the pattern
};

// The share of light that a material reflects, averaged over its texture: linear red, green, blue.
Vec3f mean_color(const SurfaceLook& look);

// A mesh drawn from both sides; its positions are relative to `origin`. One with shares shows the
// scene's surfaces, another one color.
struct RenderMesh {
  const TriangleMesh* mesh = nullptr;
  Vec3 origin{0};
  Vec3f color{0.42f, 0.39f, 0.35f};  // share of light reflected: linear red, green, blue
};

// The surface of open water; positions are relative to `origin`.
struct RenderWater {
  const TriangleMesh* mesh = nullptr;
  Vec3 origin{0};
};

// Metres, z up. What it points to must outlive its use. Meshes without normals get smooth ones.
struct RenderScene {
  const InstanceTable* stones = nullptr;
  std::optional<Vec3f> stone_color;  // on average; else a mixture of kinds of rock
  std::vector<RenderMesh> meshes;
  std::vector<SurfaceLook> surfaces;  // by index of `MaterialShares`; missing ones are plain
  std::vector<RenderWater> water;
  std::optional<double> ground;  // height of an endless plane of earth and gravel
};

struct Ball {
  Vec3 center{0};
  double radius = 0;
};

// Balls that hold everything but the ground: one per stone in the table's order, then those at the
// corners of boxes around the parts of meshes and water. A scene without any counts as one ball a
// metre wide on its ground. Throws `Error` (usage) if a position is not finite, or a mesh's shares
// are not as many as its vertices.
std::vector<Ball> bounding_balls(const RenderScene& scene);

Box3 bounds(const std::vector<Ball>& balls);
inline Box3 bounds(const RenderScene& scene) { return bounds(bounding_balls(scene)); }

}  // namespace talus
