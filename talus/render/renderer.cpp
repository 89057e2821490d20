#include "talus/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "talus/render/camera.h"
#include "talus/render/gl_objects.h"
#include "talus/render/scene_buffers.h"
#include "talus/render/shaders.h"

namespace talus {

namespace {

constexpr int kSamples = 2;            // per pixel and axis, as in shaders/common.glsl
constexpr int kShadowTexels = 2048;    // on a side of the sun's depth map
constexpr int kShadowMargin = 8;       // texels around the scene, so that its rim stays lit
constexpr int kMaterialTexels = 1024;  // as in shaders/material_textures.frag
constexpr int kMaterialLevels = 11;
constexpr double kNearPlane = 1e-3;  // in view units
constexpr double kSurroundings = 9;  // radii of the median stone that shade the large form

// As `Frame` in shaders/common.glsl.
struct Frame {
  glm::mat4 clip_from_view;
  glm::mat4 sun_from_view;
  glm::vec4 eye;
  glm::vec4 forward;
  glm::vec4 right;
  glm::vec4 up;
  glm::vec4 sun;
  glm::vec4 lengths;
};

// Matrix with these rows.
glm::mat4 rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
  return glm::mat4(glm::transpose(glm::dmat4(x, y, z, w)));
}

// Reversed depth without a far plane: the near plane is at 1, infinity at 0.
glm::mat4 clip_from_view(const Camera& camera) {
  const auto axis = [&](const Vec3& a) {
    const Vec3 scaled = a / glm::dot(a, a);
    return glm::dvec4(scaled, -glm::dot(scaled, camera.eye));
  };
  return rows(axis(camera.right), axis(camera.up), glm::dvec4(0, 0, 0, kNearPlane),
              axis(camera.forward));
}

struct SunFit {
  glm::mat4 sun_from_view;
  double texel_size = 0;  // view units
};

// The smallest square beam of sunlight that holds all balls. Depth is 1 where the beam enters the
// scene and 0 where it leaves.
SunFit fit_sun(std::span<const Ball> balls, const Vec3& sun) {
  const Vec3 top = std::abs(sun.z) > 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 right = glm::normalize(glm::cross(top, sun));
  const std::array<Vec3, 3> axes = {right, glm::cross(sun, right), sun};
  Box3 box;
  for (const Ball& ball : balls) {
    const Vec3 p(glm::dot(ball.center, axes[0]), glm::dot(ball.center, axes[1]),
                 glm::dot(ball.center, axes[2]));
    box.include(p - ball.radius);
    box.include(p + ball.radius);
  }
  const double used = std::max({box.size().x, box.size().y, 1e-6});
  const double texel = used / (kShadowTexels - 2 * kShadowMargin);
  const double side = texel * kShadowTexels;
  const double depth = std::max(box.size().z, 1e-6) + 4 * texel;
  const Vec3 middle = box.center();
  return {.sun_from_view =
              rows(glm::dvec4(axes[0] / side, 0.5 - middle.x / side),
                   glm::dvec4(axes[1] / side, 0.5 - middle.y / side),
                   glm::dvec4(axes[2] / depth, 0.5 - middle.z / depth), glm::dvec4(0, 0, 0, 1)),
          .texel_size = texel};
}

void bind_textures(std::initializer_list<const gl::Object*> textures) {
  GLuint unit = 0;
  for (const gl::Object* texture : textures) glBindTextureUnit(unit++, texture->id());
}

// What depends on the picture's size.
struct Targets {
  int width = 0;
  int height = 0;
  gl::Object surface;  // per sample: id, normal
  gl::Object depth;
  gl::Object surface_framebuffer;
  std::array<gl::Object, 2> occlusion;  // per pixel: sky visibility, distance
  std::array<gl::Object, 2> occlusion_framebuffers;

  Targets() = default;
  Targets(int w, int h)
      : width(w),
        height(h),
        surface(gl::make_texture(GL_RG32UI, kSamples * w, kSamples * h)),
        depth(gl::make_texture(GL_DEPTH_COMPONENT32F, kSamples * w, kSamples * h)),
        surface_framebuffer(gl::make_framebuffer({surface.id()}, depth.id())) {
    for (std::size_t i = 0; i < 2; ++i) {
      occlusion[i] = gl::make_texture(GL_RG32F, w, h);
      occlusion_framebuffers[i] = gl::make_framebuffer({occlusion[i].id()}, 0);
    }
  }
};

}  // namespace

struct Renderer::Impl {
  gl::ErrorLog errors;
  gl::Object shadow_program;
  gl::Object surface_program;
  gl::Object ground_program;
  gl::Object occlusion_program;
  gl::Object blur_program;
  gl::Object picture_program;
  gl::Object frame_buffer;
  gl::Object no_vertices;
  gl::Object stone_relief;
  gl::Object stone_color;
  gl::Object gravel;
  gl::Object shadow;
  gl::Object shadow_framebuffer;
  Targets targets;
  std::optional<SceneBuffers> scene;

  Impl();

  void make_material_textures();
  void upload_frame(const ViewParams& params);
  void draw_shadow();
  void draw_surfaces(bool with_ground);
  void draw_occlusion();
  void draw_picture(GLuint framebuffer);
  void fullscreen(const gl::Object& program, GLuint framebuffer, int width, int height);
};

Renderer::Impl::Impl() {
  shadow_program = gl::make_program(shaders::shadow_vert, {});
  surface_program = gl::make_program(shaders::surface_vert, shaders::surface_frag);
  ground_program = gl::make_program(shaders::fullscreen_vert, shaders::ground_frag);
  occlusion_program = gl::make_program(shaders::fullscreen_vert, shaders::occlusion_frag);
  blur_program = gl::make_program(shaders::fullscreen_vert, shaders::occlusion_blur_frag);
  picture_program = gl::make_program(shaders::fullscreen_vert, shaders::picture_frag);

  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  frame_buffer = gl::Object(buffer, [](GLuint id) { glDeleteBuffers(1, &id); });
  glNamedBufferStorage(buffer, sizeof(Frame), nullptr, GL_DYNAMIC_STORAGE_BIT);
  no_vertices = gl::make_vertex_array();

  shadow = gl::make_texture(GL_DEPTH_COMPONENT32F, kShadowTexels, kShadowTexels);
  glTextureParameteri(shadow.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(shadow.id(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  glTextureParameteri(shadow.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(shadow.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  shadow_framebuffer = gl::make_framebuffer({}, shadow.id());
  make_material_textures();
  errors.check();
}

void Renderer::Impl::make_material_textures() {
  // Slopes need more than 8 bits, or bumps seen from near turn into steps.
  stone_relief = gl::make_texture(GL_RGBA16, kMaterialTexels, kMaterialTexels, kMaterialLevels);
  stone_color = gl::make_texture(GL_RGBA8, kMaterialTexels, kMaterialTexels, kMaterialLevels);
  gravel = gl::make_texture(GL_RGBA16, kMaterialTexels, kMaterialTexels, kMaterialLevels);
  const gl::Object program =
      gl::make_program(shaders::fullscreen_vert, shaders::material_textures_frag);
  const gl::Object framebuffer =
      gl::make_framebuffer({stone_relief.id(), stone_color.id(), gravel.id()}, 0);
  glDisable(GL_DEPTH_TEST);
  fullscreen(program, framebuffer.id(), kMaterialTexels, kMaterialTexels);
  for (const gl::Object* texture : {&stone_relief, &stone_color, &gravel})
    glGenerateTextureMipmap(texture->id());
}

void Renderer::Impl::upload_frame(const ViewParams& params) {
  // The scene's balls are in view units already; a camera placed by hand is not.
  ViewParams in_view_units = params;
  if (params.eye) in_view_units.eye = scene->view_from_world(*params.eye);
  if (params.target) in_view_units.target = scene->view_from_world(*params.target);
  const Camera camera = make_camera(scene->balls(), in_view_units);
  const Vec3 sun = compass_direction(params.sun_azimuth_deg, params.sun_elevation_deg);
  const SunFit sun_fit = fit_sun(scene->balls(), sun);

  const double stone = scene->stone_radius();
  const double pixel = 2 * glm::length(camera.up) / params.height;
  const Frame frame = {
      .clip_from_view = clip_from_view(camera),
      .sun_from_view = sun_fit.sun_from_view,
      .eye = glm::dvec4(camera.eye, kNearPlane),
      .forward = glm::dvec4(camera.forward, scene->ground().value_or(0)),
      .right = glm::dvec4(camera.right, params.width),
      .up = glm::dvec4(camera.up, params.height),
      .sun = glm::dvec4(sun, sun_fit.texel_size),
      .lengths = glm::dvec4(stone, std::clamp(kSurroundings * stone, 0.1, 1.0), pixel, 0)};
  glNamedBufferSubData(frame_buffer.id(), 0, sizeof frame, &frame);
}

void Renderer::Impl::draw_shadow() {
  constexpr float kNothing = 0;
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer.id());
  glViewport(0, 0, kShadowTexels, kShadowTexels);
  glEnable(GL_DEPTH_TEST);
  glClearNamedFramebufferfv(shadow_framebuffer.id(), GL_DEPTH, 0, &kNothing);
  glUseProgram(shadow_program.id());
  scene->draw();
}

void Renderer::Impl::draw_surfaces(bool with_ground) {
  constexpr float kInfinity = 0;
  constexpr std::array<GLuint, 4> kSky = {};
  const GLuint target = targets.surface_framebuffer.id();
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, kSamples * targets.width, kSamples * targets.height);
  glEnable(GL_DEPTH_TEST);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &kInfinity);
  glClearNamedFramebufferuiv(target, GL_COLOR, 0, kSky.data());
  glUseProgram(surface_program.id());
  scene->draw();
  if (with_ground)
    fullscreen(ground_program, target, kSamples * targets.width, kSamples * targets.height);
}

void Renderer::Impl::draw_occlusion() {
  glDisable(GL_DEPTH_TEST);
  bind_textures({&targets.surface, &targets.depth});
  fullscreen(occlusion_program, targets.occlusion_framebuffers[0].id(), targets.width,
             targets.height);
  for (GLuint axis = 0; axis < 2; ++axis) {
    bind_textures({&targets.occlusion[axis], &targets.surface});
    glProgramUniform2i(blur_program.id(), 0, axis == 0, axis == 1);
    fullscreen(blur_program, targets.occlusion_framebuffers[1 - axis].id(), targets.width,
               targets.height);
  }
}

void Renderer::Impl::draw_picture(GLuint framebuffer) {
  glDisable(GL_DEPTH_TEST);
  bind_textures({&targets.surface, &targets.depth, &targets.occlusion[0], &shadow, &stone_relief,
                 &stone_color, &gravel});
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene->instances());
  fullscreen(picture_program, framebuffer, targets.width, targets.height);
}

void Renderer::Impl::fullscreen(const gl::Object& program, GLuint framebuffer, int width,
                                int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(no_vertices.id());
  glUseProgram(program.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

void Renderer::set_scene(const RenderScene& scene) {
  impl_->scene.emplace(scene);
  impl_->errors.check();
}

void Renderer::draw(const ViewParams& params, std::uint32_t framebuffer, Job* job) {
  validate_view(params);
  TALUS_ASSERT(impl_->scene.has_value());
  Impl& impl = *impl_;
  if (impl.targets.width != params.width || impl.targets.height != params.height)
    impl.targets = Targets(params.width, params.height);

  // State that a window's other drawing may have changed.
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  impl.upload_frame(params);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, impl.frame_buffer.id());

  // Drawing is queued: only waiting for it makes progress true and lets a job be cancelled midway.
  const auto done = [&](double fraction) {
    if (!job) return;
    glFinish();
    report_progress(job, "render", fraction);
  };
  done(0);
  impl.draw_shadow();
  done(0.35);
  impl.draw_surfaces(params.ground && impl.scene->ground().has_value());
  done(0.7);
  impl.draw_occlusion();
  done(0.8);
  impl.draw_picture(framebuffer);
  done(1);
  impl.errors.check();
}

}  // namespace talus
