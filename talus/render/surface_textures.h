// The textures of a landscape's materials, and how shaders read them.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <vector>

#include "talus/render/gl_objects.h"
#include "talus/render/render_scene.h"

namespace talus {

// Made once in the current context: procedurally, or from a user's pictures.
class SurfaceTextures {
 public:
  // Only the surfaces that are shown get textures. Throws `Error` (usage) for a picture whose size
  // does not fit its pixels, or that covers no area.
  SurfaceTextures(const std::vector<SurfaceLook>& looks, const std::array<bool, 8>& shown);

  // Makes them readable: textures at units 7 to 9, their description in uniform block 1. Textures
  // are anchored in the world; positions are given to the shaders relative to `eye`.
  void bind(const Vec3& eye) const;

 private:
  static constexpr std::size_t kScales = 6;  // as in shaders/landscape.glsl

  // As `Surface` in shaders/landscape.glsl.
  struct GpuSurface {
    std::array<glm::vec4, 4> tints;
    glm::vec4 layers;
    std::array<glm::vec4, kScales> phases;
  };
  // As `Surfaces` in shaders/landscape.glsl.
  struct GpuSurfaces {
    std::array<glm::vec4, 3> cloud_phases;
    std::array<GpuSurface, 8> surfaces;
  };

  // Each draws one layer of both textures.
  void draw_pattern(const char* pattern, int layer) const;
  void draw_images(const SurfaceImages& images, int layer) const;
  void attach(const gl::Object& framebuffer, GLenum target, const gl::Object& texture,
              int layer) const;

  std::vector<SurfaceLook> looks_;
  GpuSurfaces block_{};
  gl::Object no_vertices_;
  gl::Object colors_;   // square roots of the share of light reflected; height
  gl::Object reliefs_;  // slopes, roughness, hollows
  gl::Object clouds_;
  gl::Object buffer_;
};

}  // namespace talus
