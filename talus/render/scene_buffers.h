// A scene in the graphics card's memory.
#pragma once

#include <vector>

#include "talus/render/gl_objects.h"
#include "talus/render/render_scene.h"

namespace talus {

// Everything in it is in view units: the scene's middle is the origin, and half the diagonal of its
// bounds is 1. So the same tolerances serve a pebble and a valley, and float suffices anywhere.
class SceneBuffers {
 public:
  // Needs a current context. Throws `Error` (usage) as `bounding_balls` does.
  explicit SceneBuffers(const RenderScene& scene);

  // Draws all triangles with the bound program: stones from outside, meshes from both sides.
  void draw() const;

  Vec3 view_from_world(const Vec3& p) const { return (p - center_) / radius_; }

  GLuint instances() const { return instances_.id(); }
  const std::vector<Ball>& balls() const { return balls_; }  // in view units
  double stone_radius() const { return stone_radius_; }      // of the median stone
  const std::optional<double>& ground() const { return ground_; }

 private:
  Vec3 center_{0};
  double radius_ = 1;
  std::vector<Ball> balls_;
  double stone_radius_ = 0;
  std::optional<double> ground_;
  gl::Object vertices_;
  gl::Object indices_;
  gl::Object instances_;
  gl::Object commands_;
  gl::Object vertex_array_;
  GLsizei stone_commands_ = 0;
  GLsizei mesh_commands_ = 0;
};

}  // namespace talus
