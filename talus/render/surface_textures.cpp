#include "talus/render/surface_textures.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/error.h"
#include "talus/render/shaders.h"

namespace talus {

namespace {

constexpr int kTexels = 512;  // as in shaders/surface_*.frag
constexpr int kLevels = 10;
constexpr int kCloudTexels = 512;
constexpr int kCloudLevels = 10;
constexpr double kScaleStep = 8;    // as in shaders/landscape.glsl
constexpr double kPhasePeriod = 5;  // units after which also a turned texture repeats

// Metres that clouds and beds cover, as in shaders/landscape.glsl.
constexpr std::array<double, 3> kCloudSizes = {45, 360, 2900};

// How a pattern is drawn: functions in shaders/surface_pattern.frag.
struct PatternTraits {
  std::array<const char*, 4> layers;  // for what faces up and aside, then for their large scales
  double size;                        // metres after which it repeats
  float variety;                      // of its color from place to place
};

PatternTraits traits(SurfaceLook::Pattern pattern) {
  switch (pattern) {
    case SurfaceLook::Pattern::plain:
      return {{"plain", "plain", "plain", "plain"}, 4, 0};
    case SurfaceLook::Pattern::rock:
      return {{"slab", "cliff", "massif", "wall"}, 5, 1};
    case SurfaceLook::Pattern::sand:
      return {{"sand", "sand", "dunes", "dunes"}, 2, 0.35f};
    case SurfaceLook::Pattern::soil:
      return {{"soil", "soil", "meadow", "meadow"}, 3, 0.8f};
    case SurfaceLook::Pattern::gravel:
      return {{"gravel", "gravel", "scree", "scree"}, 2, 0.5f};
    case SurfaceLook::Pattern::ice:
      return {{"ice", "ice", "ice", "ice"}, 8, 0.2f};
    case SurfaceLook::Pattern::snow:
      return {{"snow", "snow", "snow", "snow"}, 6, 0.1f};
  }
  return {};
}

// Where a place lies in a texture of this size.
Vec3 phase(const Vec3& place, double size) {
  const Vec3 units = place / size;
  return units - kPhasePeriod * glm::floor(units / kPhasePeriod);
}

void check(const Image& image, const char* what) {
  if (image.pixels.empty()) return;
  const bool channels = image.channels == 1 || image.channels == 3 || image.channels == 4;
  if (!channels || image.width < 1 || image.height < 1 ||
      image.pixels.size() != static_cast<std::size_t>(image.width) *
                                 static_cast<std::size_t>(image.height) *
                                 static_cast<std::size_t>(image.channels))
    throw usage_error(
        fmt::format("the {} picture of a surface has {} bytes, not those of {} x {} "
                    "pixels with 1, 3 or 4 channels",
                    what, image.pixels.size(), image.width, image.height));
}

// A picture as a texture; one grey pixel for none.
gl::Object upload(const Image& image, GLenum color_format) {
  static const Image kNone{.width = 1, .height = 1, .channels = 1, .pixels = {128}};
  const Image& used = image.pixels.empty() ? kNone : image;
  int levels = 1;
  while ((std::max(used.width, used.height) >> levels) > 0) ++levels;
  gl::Object texture = gl::make_texture(color_format, used.width, used.height, levels);
  const GLenum layout = used.channels == 1 ? GL_RED : used.channels == 3 ? GL_RGB : GL_RGBA;
  if (used.channels == 1)
    for (const GLenum swizzle : {GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B})
      glTextureParameteri(texture.id(), swizzle, GL_RED);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.id(), 0, 0, 0, used.width, used.height, layout, GL_UNSIGNED_BYTE,
                      used.pixels.data());
  glGenerateTextureMipmap(texture.id());
  return texture;
}

}  // namespace

SurfaceTextures::SurfaceTextures(const std::vector<SurfaceLook>& looks,
                                 const std::array<bool, 8>& shown)
    : looks_(looks) {
  looks_.resize(shown.size());
  for (SurfaceLook& look : looks_) {
    if (!look.images) continue;
    check(look.images->albedo, "albedo");
    check(look.images->normal, "normal");
    check(look.images->roughness, "roughness");
    check(look.images->height, "height");
    if (!(look.images->size > 0) || !std::isfinite(look.images->size))
      throw usage_error(fmt::format("the pictures of a surface cover {} m; give a length above 0",
                                    look.images->size));
  }

  // A layer for each pattern and each set of pictures.
  std::vector<const char*> patterns;  // of each layer; null: pictures
  std::array<std::array<std::size_t, 4>, 8> layers_of{};
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!shown[i]) continue;
    if (looks_[i].images) {
      layers_of[i].fill(patterns.size());
      patterns.push_back(nullptr);
      continue;
    }
    const PatternTraits t = traits(looks_[i].pattern);
    for (std::size_t use = 0; use < t.layers.size(); ++use) {
      const std::string_view wanted = t.layers[use];
      const auto found = std::find_if(patterns.begin(), patterns.end(), [&](const char* pattern) {
        return pattern && pattern == wanted;
      });
      layers_of[i][use] = static_cast<std::size_t>(found - patterns.begin());
      if (found == patterns.end()) patterns.push_back(t.layers[use]);
    }
  }
  const int layers = std::max(static_cast<int>(patterns.size()), 1);
  colors_ = gl::make_texture_array(GL_RGBA8, kTexels, layers, kLevels);
  reliefs_ = gl::make_texture_array(GL_RGBA16, kTexels, layers, kLevels);
  clouds_ = gl::make_texture(GL_RGBA8, kCloudTexels, kCloudTexels, kCloudLevels);
  buffer_ = gl::make_changing_buffer();
  no_vertices_ = gl::make_vertex_array();

  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glBindVertexArray(no_vertices_.id());
  for (std::size_t layer = 0; layer < patterns.size(); ++layer)
    if (patterns[layer]) draw_pattern(patterns[layer], static_cast<int>(layer));
  for (std::size_t i = 0; i < looks_.size(); ++i)
    if (shown[i] && looks_[i].images)
      draw_images(*looks_[i].images, static_cast<int>(layers_of[i][0]));
  const gl::Object program =
      gl::make_program({shaders::fullscreen_vert}, {shaders::noise_glsl, shaders::clouds_frag});
  const gl::Object framebuffer = gl::make_framebuffer({clouds_.id()}, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, kCloudTexels, kCloudTexels);
  glUseProgram(program.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  for (const gl::Object* texture : {&colors_, &reliefs_, &clouds_})
    glGenerateTextureMipmap(texture->id());

  // The last level is the mean, by which the colors asked for are reached.
  std::vector<glm::u8vec4> means(static_cast<std::size_t>(layers));
  glGetTextureImage(colors_.id(), kLevels - 1, GL_RGBA, GL_UNSIGNED_BYTE,
                    static_cast<GLsizei>(means.size() * sizeof(glm::u8vec4)), means.data());
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!shown[i]) continue;
    const PatternTraits t = traits(looks_[i].pattern);
    const SurfaceLook& look = looks_[i];
    GpuSurface& surface = block_.surfaces[i];
    for (int use = 0; use < 4; ++use) {
      const std::size_t layer = layers_of[i][static_cast<std::size_t>(use)];
      Vec3f mean;
      for (int c = 0; c < 3; ++c)
        mean[c] = std::pow(static_cast<float>(means[layer][c]) / 255, 2.0f);
      surface.tints[static_cast<std::size_t>(use)] =
          glm::vec4(mean_color(look) / glm::max(mean, Vec3f(1e-3f)), 0);
      surface.layers[use] = static_cast<float>(layer);
    }
    surface.tints[0].w = static_cast<float>(look.images ? look.images->size : t.size);
    for (glm::vec4& p : surface.phases) p.w = look.images ? 0.5f : t.variety;
  }
}

void SurfaceTextures::attach(const gl::Object& framebuffer, GLenum target,
                             const gl::Object& texture, int layer) const {
  glNamedFramebufferTextureLayer(framebuffer.id(), target, texture.id(), 0, layer);
}

void SurfaceTextures::draw_pattern(const char* pattern, int layer) const {
  const std::string define = fmt::format("#define PATTERN {}\n", pattern);
  const gl::Object program = gl::make_program(
      {shaders::fullscreen_vert}, {define, shaders::noise_glsl, shaders::surface_pattern_frag});
  const gl::Object relief_program =
      gl::make_program({shaders::fullscreen_vert}, {shaders::surface_relief_frag});
  constexpr std::array<GLenum, 2> kBoth = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};

  const gl::Object heights = gl::make_texture(GL_RG32F, kTexels, kTexels);
  const gl::Object framebuffer = gl::make_framebuffer();
  attach(framebuffer, GL_COLOR_ATTACHMENT0, colors_, layer);
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT1, heights.id(), 0);
  glNamedFramebufferDrawBuffers(framebuffer.id(), 2, kBoth.data());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, kTexels, kTexels);
  glUseProgram(program.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);

  const gl::Object relief_framebuffer = gl::make_framebuffer();
  attach(relief_framebuffer, GL_COLOR_ATTACHMENT0, reliefs_, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, relief_framebuffer.id());
  glBindTextureUnit(0, heights.id());
  glUseProgram(relief_program.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SurfaceTextures::draw_images(const SurfaceImages& images, int layer) const {
  const gl::Object program =
      gl::make_program({shaders::fullscreen_vert}, {shaders::surface_images_frag});
  constexpr std::array<GLenum, 2> kBoth = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  const std::array<gl::Object, 4> textures = {
      upload(images.albedo, GL_SRGB8_ALPHA8), upload(images.normal, GL_RGBA8),
      upload(images.roughness, GL_RGBA8), upload(images.height, GL_RGBA8)};
  for (GLuint unit = 0; unit < textures.size(); ++unit)
    glBindTextureUnit(unit, textures[unit].id());
  const auto there = [](const Image& image) { return image.pixels.empty() ? 0 : 1; };
  glProgramUniform4i(program.id(), 0, there(images.normal), there(images.roughness),
                     there(images.height),
                     (images.albedo.channels == 4 ? 1 : 0) + (images.normal.channels == 4 ? 2 : 0));

  const gl::Object framebuffer = gl::make_framebuffer();
  attach(framebuffer, GL_COLOR_ATTACHMENT0, colors_, layer);
  attach(framebuffer, GL_COLOR_ATTACHMENT1, reliefs_, layer);
  glNamedFramebufferDrawBuffers(framebuffer.id(), 2, kBoth.data());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, kTexels, kTexels);
  glUseProgram(program.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SurfaceTextures::bind(const Vec3& eye) const {
  GpuSurfaces block = block_;
  for (std::size_t i = 0; i < kCloudSizes.size(); ++i)
    block.cloud_phases[i] = glm::vec4(phase(eye, kCloudSizes[i]), kCloudSizes[i]);
  for (GpuSurface& surface : block.surfaces) {
    double size = std::max(surface.tints[0].w, 1e-6f);
    for (glm::vec4& p : surface.phases) {
      p = glm::vec4(phase(eye, size), p.w);
      size *= kScaleStep;
    }
  }
  gl::update_buffer(buffer_, &block, sizeof block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 1, buffer_.id());
  glBindTextureUnit(7, colors_.id());
  glBindTextureUnit(8, reliefs_.id());
  glBindTextureUnit(9, clouds_.id());
}

}  // namespace talus
