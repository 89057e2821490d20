#include "talus/render/picture.h"

#include <algorithm>

#include "talus/render/camera.h"
#include "talus/render/gl_objects.h"
#include "talus/render/headless_context.h"
#include "talus/render/renderer.h"

namespace talus {

Image render_picture(const RenderScene& scene, const ViewParams& params, Job* job) {
  validate_view(params);
  const HeadlessContext context;
  Renderer renderer;
  renderer.set_scene(scene);

  const gl::Object color = gl::make_texture(GL_RGBA8, params.width, params.height);
  const gl::Object framebuffer = gl::make_framebuffer({color.id()}, 0);
  renderer.draw(params, framebuffer.id(), job);

  Image image{.width = params.width, .height = params.height, .channels = 3};
  const std::size_t row = 3 * static_cast<std::size_t>(params.width);
  image.pixels.resize(row * static_cast<std::size_t>(params.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(color.id(), 0, GL_RGB, GL_UNSIGNED_BYTE,
                    static_cast<GLsizei>(image.pixels.size()), image.pixels.data());

  // OpenGL's rows run from the bottom up.
  for (auto top = image.pixels.begin(), bottom = image.pixels.end(); top < bottom;
       top += static_cast<std::ptrdiff_t>(row)) {
    bottom -= static_cast<std::ptrdiff_t>(row);
    if (top < bottom) std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
  }
  return image;
}

}  // namespace talus
