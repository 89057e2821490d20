// A scene in the graphics card's memory.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "talus/render/gl_objects.h"
#include "talus/render/mesh_buffers.h"
#include "talus/render/render_scene.h"
#include "talus/render/stone_buffers.h"

namespace talus {

// Everything in it is in view units: the scene's middle is the origin, and half the diagonal of its
// bounds is 1. So the same tolerances serve a pebble and a valley, and float suffices anywhere.
class SceneBuffers {
 public:
  // Needs a current context. Throws `Error` (usage) as `bounding_balls` does.
  explicit SceneBuffers(const RenderScene& scene);
  SceneBuffers(const SceneBuffers&) = delete;
  SceneBuffers& operator=(const SceneBuffers&) = delete;

  // Each draws what is in sight with the bound program: stones from outside, all else from both
  // sides.
  void draw_stones(const Sight& sight) const;
  void draw_meshes(const Sight& sight) const;
  void draw_water(const Sight& sight) const;
  // A landscape's meshes, their vertices moved inside cubic cells of at most `large_form_cell`.
  void draw_large_forms(const Sight& sight) const;
  double large_form_cell() const { return large_form_cell_; }

  Vec3 view_from_world(const Vec3& p) const { return (p - center_) / radius_; }
  Vec3 world_from_view(const Vec3& p) const { return center_ + radius_ * p; }
  double metres() const { return radius_; }  // that a view unit is long

  GLuint instances() const { return instances_.id(); }
  const std::vector<Ball>& balls() const { return balls_; }  // in view units, stones first
  std::span<const Ball> mesh_balls() const { return std::span(balls_).subspan(stone_count_); }
  // Radius of the median stone, else the size of the smallest shapes.
  double detail_radius() const { return detail_radius_; }
  const std::optional<double>& ground() const { return ground_; }

  // Which surfaces its meshes show; a landscape is a scene with any, or with water.
  const std::array<bool, 8>& shown_surfaces() const { return shown_surfaces_; }
  bool is_landscape() const { return landscape_; }
  bool has_stones() const { return stones_.has_value(); }
  bool has_water() const { return water_.has_value(); }

 private:
  std::vector<GpuInstance> stone_instances(const RenderScene& scene) const;
  void make_large_forms(std::vector<PlacedMesh> meshes);

  Vec3 center_{0};
  double radius_ = 1;
  std::size_t stone_count_ = 0;
  std::vector<Ball> balls_;
  double detail_radius_ = 0;
  std::optional<double> ground_;
  std::array<bool, 8> shown_surfaces_{};
  bool landscape_ = false;
  gl::Object instances_;
  std::optional<StoneBuffers> stones_;
  std::optional<MeshBuffers> meshes_;
  std::optional<MeshBuffers> water_;
  std::optional<MeshBuffers> large_forms_;
  double large_form_cell_ = 0;
};

}  // namespace talus
