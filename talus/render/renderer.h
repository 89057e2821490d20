// Draws scenes with OpenGL, into a window or without one.
#pragma once

#include <cstdint>
#include <memory>

#include "talus/base/job.h"
#include "talus/base/view_params.h"
#include "talus/render/render_scene.h"

namespace talus {

// Owns what it makes in the context (OpenGL 4.5 core) that was current when it was made; that
// context must be current in every call and at destruction. Equal input gives equal pixels on one
// driver. Every function throws `Error` (job) if OpenGL reports an error.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Takes over all of the scene; only for a low camera must what it points to outlive `draw`.
  // Throws `Error` (usage) if a position is not finite.
  void set_scene(const RenderScene& scene);

  // Draws the scene into the lower left `width` x `height` pixels of a framebuffer's first color
  // target (0 is the window's); `set_scene` comes first. Throws `Error` (usage) for wrong params,
  // `Cancelled`.
  void draw(const ViewParams& params, std::uint32_t framebuffer = 0, Job* job = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace talus
