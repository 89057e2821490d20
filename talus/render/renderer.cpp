#include "talus/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <string>

#include "talus/render/camera.h"
#include "talus/render/gl_objects.h"
#include "talus/render/projection.h"
#include "talus/render/scene_buffers.h"
#include "talus/render/shaders.h"
#include "talus/render/standpoint.h"
#include "talus/render/surface_textures.h"

namespace talus {

namespace {

constexpr int kSamples = 2;       // per pixel and axis, as in shaders/common.glsl
constexpr int kSunMaps = 4;       // likewise
constexpr int kSunTexels = 2048;  // on a side of the sun's depth maps
constexpr int kSkyTexels = 512;   // of the sky's
// Samples that a texel of a depth map counts: shadows are blurred over more than four texels.
constexpr double kSamplesPerTexel = 0.6;
constexpr int kMaterialTexels = 1024;  // as in shaders/*_texture*.frag
constexpr int kMaterialLevels = 11;
constexpr int kMeterTexels = 64;  // as in shaders/picture.frag
constexpr int kMeterLevels = 7;
constexpr double kNearPlane = 1e-3;        // in view units; where a person may stand, of
constexpr double kNearMetres = 0.1;        // this many metres, yet no less than
constexpr double kNearPlaneMin = 1e-5;     // in view units
constexpr double kSurroundings = 9;        // radii of the median stone that shade the large form
constexpr double kHazeDistance = 160'000;  // metres over which air veils 63 %, and no less than
constexpr double kHazeScenes = 30;         // this many radii of the scene

// As `Frame` in shaders/common.glsl.
struct Frame {
  glm::mat4 clip_from_view;
  std::array<glm::mat4, kSunMaps> sun_from_view;
  glm::vec4 sun_texels;
  glm::vec4 eye;
  glm::vec4 forward;
  glm::vec4 right;
  glm::vec4 up;
  glm::vec4 sun;
  glm::vec4 lengths;
  glm::vec4 air;
};

// As `Sky` in shaders/occlusion.frag.
struct Sky {
  std::array<glm::mat4, kSkyDirections> sky_from_view;
  std::array<glm::vec4, kSkyDirections> directions;
};

void bind_textures(std::initializer_list<const gl::Object*> textures) {
  GLuint unit = 0;
  for (const gl::Object* texture : textures) glBindTextureUnit(unit++, texture->id());
}

// State that a window's other drawing may have changed.
void prepare_state() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

// What depends on the picture's size.
struct Targets {
  int width = 0;
  int height = 0;
  gl::Object surface;  // per sample: id, normal
  gl::Object shares;   // per sample, in a landscape
  gl::Object depth;
  gl::Object water_depth;  // where there is water
  gl::Object surface_framebuffer;
  gl::Object shares_framebuffer;
  gl::Object water_framebuffer;
  std::array<gl::Object, 2> occlusion;  // per pixel, as in shaders/occlusion.frag
  std::array<gl::Object, 2> occlusion_framebuffers;

  Targets() = default;
  Targets(int w, int h, bool landscape, bool water)
      : width(w),
        height(h),
        surface(gl::make_texture(GL_RG32UI, kSamples * w, kSamples * h)),
        shares(landscape ? gl::make_texture(GL_RG32UI, kSamples * w, kSamples * h) : gl::Object()),
        depth(gl::make_texture(GL_DEPTH_COMPONENT32F, kSamples * w, kSamples * h)),
        water_depth(gl::make_texture(GL_DEPTH_COMPONENT32F, water ? kSamples * w : 1,
                                     water ? kSamples * h : 1)),
        surface_framebuffer(gl::make_framebuffer({surface.id()}, depth.id())),
        water_framebuffer(gl::make_framebuffer({}, water_depth.id())) {
    if (landscape)
      shares_framebuffer = gl::make_framebuffer({surface.id(), shares.id()}, depth.id());
    for (std::size_t i = 0; i < 2; ++i) {
      occlusion[i] = gl::make_texture(GL_RGBA32F, w, h);
      occlusion_framebuffers[i] = gl::make_framebuffer({occlusion[i].id()}, 0);
    }
  }
};

// Which parts a scene asks of the programs.
struct Features {
  bool landscape = false;
  bool stones = false;
  bool plane = false;
  bool water = false;
  bool operator==(const Features&) const = default;

  std::string defines() const {
    std::string text;
    if (landscape) text += "#define LANDSCAPE\n";
    if (stones) text += "#define STONES\n";
    if (plane) text += "#define PLANE\n";
    if (water) text += "#define WATER\n";
    return text;
  }
};

// Programs made for a scene's features: what they leave out need not be compiled.
struct Programs {
  Features features;
  gl::Object surface;
  gl::Object mesh;
  gl::Object occlusion;
  gl::Object meter;
  gl::Object picture;

  Programs() = default;
  explicit Programs(const Features& of) : features(of) {
    using namespace shaders;
    const std::string defines = of.defines();
    const std::string_view many = of.landscape ? landscape_glsl : "";
    constexpr std::string_view kShares = "#define SHARES\n";
    surface = gl::make_program({surface_vert}, {surface_frag});
    if (of.landscape) mesh = gl::make_program({kShares, surface_vert}, {kShares, surface_frag});
    occlusion = gl::make_program({fullscreen_vert}, {defines, occlusion_frag});
    picture =
        gl::make_program({fullscreen_vert}, {defines, light_glsl, stones_glsl, many, picture_frag});
    if (of.landscape)
      meter = gl::make_program({fullscreen_vert}, {defines, "#define METER\n", light_glsl,
                                                   stones_glsl, many, picture_frag});
  }
};

}  // namespace

struct Renderer::Impl {
  gl::ErrorLog errors;
  gl::Object depth_program;
  gl::Object ground_program;
  gl::Object blur_program;
  Programs programs;
  gl::Object frame_buffer;
  gl::Object sky_buffer;
  gl::Object no_vertices;
  gl::Object stone_relief;
  gl::Object stone_color;
  gl::Object gravel;
  gl::Object sun_maps;
  gl::Object sky_maps;
  gl::Object map_framebuffer;
  gl::Object meter;
  gl::Object meter_framebuffer;
  Targets targets;
  std::optional<RenderScene> shown;  // for what is asked of it anew for each picture
  std::optional<SceneBuffers> scene;
  std::optional<SurfaceTextures> surfaces;

  // Of the picture that is being drawn.
  Camera camera;
  std::vector<LightMap> suns;
  std::optional<Sight> sight;

  Impl();

  void make_material_textures(const Features& features);
  void draw_textures(std::string_view shader, std::initializer_list<GLuint> textures);
  void set_scene(const RenderScene& render_scene);
  void draw_sky_maps();
  void look(const ViewParams& params);
  Sight begin_map(const gl::Object& maps, int layer, int texels, const LightMap& map);
  void draw_sun_maps();
  void draw_surfaces(bool with_ground);
  void draw_water();
  void draw_occlusion();
  void draw_picture(bool inside, GLuint framebuffer);
  void fullscreen(const gl::Object& program, GLuint framebuffer, int width, int height);
};

Renderer::Impl::Impl() {
  depth_program = gl::make_program({shaders::depth_vert}, {});
  ground_program = gl::make_program({shaders::fullscreen_vert}, {shaders::ground_frag});
  blur_program = gl::make_program({shaders::fullscreen_vert}, {shaders::occlusion_blur_frag});
  frame_buffer = gl::make_changing_buffer();
  sky_buffer = gl::make_changing_buffer();
  no_vertices = gl::make_vertex_array();

  sun_maps = gl::make_texture_array(GL_DEPTH_COMPONENT32F, kSunTexels, kSunMaps);
  gl::compare_depths(sun_maps);
  map_framebuffer = gl::make_framebuffer();
  meter = gl::make_texture(GL_RGBA16F, kMeterTexels, kMeterTexels, kMeterLevels);
  // Pictures from outside sample it too, though they use nothing of it.
  for (int level = 0; level < kMeterLevels; ++level)
    glClearTexImage(meter.id(), level, GL_RGBA, GL_FLOAT, nullptr);
  meter_framebuffer = gl::make_framebuffer({meter.id()}, 0);
  errors.check();
}

void Renderer::Impl::make_material_textures(const Features& features) {
  if ((features.stones || features.plane) && stone_relief.id() == 0) {
    // Slopes need more than 8 bits, or bumps seen from near turn into steps.
    stone_relief = gl::make_texture(GL_RGBA16, kMaterialTexels, kMaterialTexels, kMaterialLevels);
    stone_color = gl::make_texture(GL_RGBA8, kMaterialTexels, kMaterialTexels, kMaterialLevels);
    draw_textures(shaders::stone_textures_frag, {stone_relief.id(), stone_color.id()});
  }
  if (features.plane && gravel.id() == 0) {
    gravel = gl::make_texture(GL_RGBA16, kMaterialTexels, kMaterialTexels, kMaterialLevels);
    draw_textures(shaders::gravel_texture_frag, {gravel.id()});
  }
}

void Renderer::Impl::draw_textures(std::string_view shader,
                                   std::initializer_list<GLuint> textures) {
  const gl::Object program =
      gl::make_program({shaders::fullscreen_vert}, {shaders::noise_glsl, shader});
  const gl::Object framebuffer = gl::make_framebuffer(textures, 0);
  glDisable(GL_DEPTH_TEST);
  fullscreen(program, framebuffer.id(), kMaterialTexels, kMaterialTexels);
  for (const GLuint texture : textures) glGenerateTextureMipmap(texture);
}

void Renderer::Impl::set_scene(const RenderScene& render_scene) {
  scene.emplace(render_scene);
  shown = render_scene;
  surfaces.reset();
  targets = {};
  if (scene->is_landscape()) surfaces.emplace(render_scene.surfaces, scene->shown_surfaces());
  const Features features = {.landscape = scene->is_landscape(),
                             .stones = scene->has_stones(),
                             .plane = scene->ground().has_value(),
                             .water = scene->has_water()};
  if (programs.picture.id() == 0 || programs.features != features) programs = Programs(features);
  make_material_textures(features);
  if (scene->is_landscape()) draw_sky_maps();
}

// What each part of the sky sees of the large forms; stones shade only what is near them.
void Renderer::Impl::draw_sky_maps() {
  sky_maps = gl::make_texture_array(GL_DEPTH_COMPONENT32F, kSkyTexels, kSkyDirections);
  gl::compare_depths(sky_maps);
  Sky sky;
  const std::array<Vec3, kSkyDirections> directions = sky_directions();
  prepare_state();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene->instances());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const LightMap map = fit_light(scene->mesh_balls(), directions[i], kSkyTexels);
    scene->draw_large_forms(begin_map(sky_maps, static_cast<int>(i), kSkyTexels, map));
    sky.sky_from_view[i] = glm::mat4(map.map_from_view);
    sky.directions[i] = glm::dvec4(directions[i], std::max(map.texel, scene->large_form_cell()));
  }
  gl::update_buffer(sky_buffer, &sky, sizeof sky);
}

void Renderer::Impl::look(const ViewParams& params) {
  // The scene's balls are in view units already; a camera placed by hand is not.
  ViewParams in_view_units = params;
  if (!params.elevation_deg && scene->is_landscape()) in_view_units.elevation_deg = kLandElevation;
  if (params.camera == CameraPreset::low) {
    const Standpoint standpoint = find_standpoint(*shown, params);
    in_view_units.eye = standpoint.eye;
    in_view_units.target = standpoint.target;
  }
  if (in_view_units.eye) {
    in_view_units.eye = scene->view_from_world(*in_view_units.eye);
    in_view_units.target = scene->view_from_world(*in_view_units.target);
  }
  camera = make_camera(scene->balls(), in_view_units);
  const Vec3 sun = compass_direction(params.sun_azimuth_deg, params.sun_elevation_deg);
  suns = fit_sun(scene->balls(), sun, camera, kSunTexels, kSunMaps);

  const bool placed = params.eye || params.camera == CameraPreset::low;
  const double near_plane =
      placed ? std::clamp(kNearMetres / scene->metres(), kNearPlaneMin, kNearPlane) : kNearPlane;
  const glm::dmat4 clip = clip_from_view(camera, near_plane);
  const double pixel = 2 * glm::length(camera.up) / params.height;
  sight.emplace(clip, kSamples / pixel);
  const double detail = scene->detail_radius();
  const double surroundings = scene->is_landscape() ? std::clamp(kSurroundings * detail, 1e-5, 1.0)
                                                    : std::clamp(kSurroundings * detail, 0.1, 1.0);
  const double haze = std::min(scene->metres() / kHazeDistance, 1.0) + 1 / kHazeScenes;
  const bool metered = params.camera == CameraPreset::inside && scene->is_landscape();
  Frame frame = {.clip_from_view = glm::mat4(clip),
                 .sun_from_view = {},
                 .sun_texels = {},
                 .eye = glm::dvec4(camera.eye, near_plane),
                 .forward = glm::dvec4(camera.forward, scene->ground().value_or(0)),
                 .right = glm::dvec4(camera.right, params.width),
                 .up = glm::dvec4(camera.up, params.height),
                 .sun = glm::dvec4(sun, suns.size()),
                 .lengths = glm::dvec4(detail, surroundings, pixel, scene->metres()),
                 .air = glm::dvec4(haze, metered ? 1.0 : 0.0, 0, 0)};
  for (std::size_t i = 0; i < suns.size(); ++i) {
    frame.sun_from_view[i] = glm::mat4(suns[i].map_from_view);
    frame.sun_texels[static_cast<int>(i)] = static_cast<float>(suns[i].texel);
  }
  gl::update_buffer(frame_buffer, &frame, sizeof frame);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer.id());
  glBindBufferBase(GL_UNIFORM_BUFFER, 2, sky_buffer.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene->instances());
  if (surfaces) surfaces->bind(scene->world_from_view(camera.eye));
}

Sight Renderer::Impl::begin_map(const gl::Object& maps, int layer, int texels,
                                const LightMap& map) {
  constexpr float kNothing = 0;
  const GLuint target = map_framebuffer.id();
  glNamedFramebufferTextureLayer(target, GL_DEPTH_ATTACHMENT, maps.id(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, texels, texels);
  glEnable(GL_DEPTH_TEST);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &kNothing);
  glUseProgram(depth_program.id());
  const glm::dmat4 clip = clip_from_view(map);
  const glm::mat4 uniform(clip);
  glProgramUniformMatrix4fv(depth_program.id(), 0, 1, GL_FALSE, &uniform[0][0]);
  return Sight(clip, kSamplesPerTexel / map.texel);
}

void Renderer::Impl::draw_sun_maps() {
  for (std::size_t i = 0; i < suns.size(); ++i) {
    const Sight seen = begin_map(sun_maps, static_cast<int>(i), kSunTexels, suns[i]);
    scene->draw_stones(seen);
    scene->draw_meshes(seen);
  }
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
  glUseProgram(programs.surface.id());
  scene->draw_stones(*sight);
  if (scene->is_landscape()) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets.shares_framebuffer.id());
    glUseProgram(programs.mesh.id());
  }
  scene->draw_meshes(*sight);
  if (scene->has_water()) draw_water();
  if (with_ground)
    fullscreen(ground_program, target, kSamples * targets.width, kSamples * targets.height);
}

void Renderer::Impl::draw_water() {
  constexpr float kInfinity = 0;
  const GLuint target = targets.water_framebuffer.id();
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glEnable(GL_DEPTH_TEST);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, &kInfinity);
  glUseProgram(programs.surface.id());
  scene->draw_water(*sight);
}

void Renderer::Impl::draw_occlusion() {
  glDisable(GL_DEPTH_TEST);
  bind_textures({&targets.surface, &targets.depth, &sky_maps});
  fullscreen(programs.occlusion, targets.occlusion_framebuffers[0].id(), targets.width,
             targets.height);
  for (GLuint axis = 0; axis < 2; ++axis) {
    bind_textures({&targets.occlusion[axis], &targets.surface});
    glProgramUniform2i(blur_program.id(), 0, axis == 0, axis == 1);
    fullscreen(blur_program, targets.occlusion_framebuffers[1 - axis].id(), targets.width,
               targets.height);
  }
}

void Renderer::Impl::draw_picture(bool inside, GLuint framebuffer) {
  glDisable(GL_DEPTH_TEST);
  bind_textures({&targets.surface, &targets.depth, &targets.occlusion[0], &sun_maps, &stone_relief,
                 &stone_color, &gravel});
  glBindTextureUnit(10, targets.shares.id());
  glBindTextureUnit(11, targets.water_depth.id());
  glBindTextureUnit(12, meter.id());
  if (inside && scene->is_landscape()) {
    fullscreen(programs.meter, meter_framebuffer.id(), kMeterTexels, kMeterTexels);
    glGenerateTextureMipmap(meter.id());
  }
  fullscreen(programs.picture, framebuffer, targets.width, targets.height);
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
  impl_->set_scene(scene);
  impl_->errors.check();
}

void Renderer::draw(const ViewParams& params, std::uint32_t framebuffer, Job* job) {
  validate_view(params);
  TALUS_ASSERT(impl_->scene.has_value());
  Impl& impl = *impl_;
  if (impl.targets.width != params.width || impl.targets.height != params.height)
    impl.targets =
        Targets(params.width, params.height, impl.scene->is_landscape(), impl.scene->has_water());
  prepare_state();
  impl.look(params);

  // Drawing is queued: only waiting for it makes progress true and lets a job be cancelled midway.
  const auto done = [&](double fraction) {
    if (!job) return;
    glFinish();
    report_progress(job, "render", fraction);
  };
  done(0);
  impl.draw_sun_maps();
  done(0.35);
  impl.draw_surfaces(params.ground && impl.scene->ground().has_value());
  done(0.7);
  impl.draw_occlusion();
  done(0.8);
  impl.draw_picture(params.camera == CameraPreset::inside, framebuffer);
  done(1);
  impl.errors.check();
}

}  // namespace talus
