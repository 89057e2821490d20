#include "talus/render/gl_objects.h"

#include <array>
#include <string>
#include <vector>

#include "talus/base/error.h"
#include "talus/render/shaders.h"

namespace talus::gl {

namespace {

Object compile(GLenum stage, std::string_view text) {
  Object shader(glCreateShader(stage), [](GLuint id) { glDeleteShader(id); });
  const std::array<const char*, 2> texts = {shaders::common_glsl.data(), text.data()};
  const std::array<GLint, 2> lengths = {static_cast<GLint>(shaders::common_glsl.size()),
                                        static_cast<GLint>(text.size())};
  glShaderSource(shader.id(), 2, texts.data(), lengths.data());
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw job_error("the OpenGL driver refuses a shader: " + log);
}

void GLAPIENTRY keep_first_error(GLenum, GLenum type, GLuint, GLenum, GLsizei,
                                 const GLchar* message, const void* first) {
  // No exception may pass through the driver: `check` throws later.
  auto& text = *static_cast<std::string*>(const_cast<void*>(first));
  if (type == GL_DEBUG_TYPE_ERROR && text.empty()) text = message;
}

}  // namespace

ErrorLog::ErrorLog() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(keep_first_error, &first_);
}

ErrorLog::~ErrorLog() { glDebugMessageCallback(nullptr, nullptr); }

void ErrorLog::check() const {
  if (!first_.empty()) throw job_error("OpenGL reports an error: " + first_);
}

Object make_buffer(const void* data, std::size_t size) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Object buffer(id, [](GLuint b) { glDeleteBuffers(1, &b); });
  // OpenGL has no buffers without bytes.
  if (size == 0) {
    constexpr std::array<char, 64> kNothing{};
    glNamedBufferStorage(id, sizeof kNothing, kNothing.data(), 0);
  } else {
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(size), data, 0);
  }
  return buffer;
}

Object make_vertex_array() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return {id, [](GLuint a) { glDeleteVertexArrays(1, &a); }};
}

Object make_texture(GLenum format, int width, int height, int levels) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  glTextureStorage2D(id, levels, format, width, height);
  const bool filtered = levels > 1;
  const auto wrap = filtered ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, wrap);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, wrap);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, filtered ? GL_LINEAR : GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, filtered ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  return {id, [](GLuint t) { glDeleteTextures(1, &t); }};
}

Object make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  std::vector<GLenum> targets;
  for (const GLuint color : colors) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    glNamedFramebufferTexture(id, targets.back(), color, 0);
  }
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(targets.size()), targets.data());
  if (depth != 0) glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth, 0);
  Object framebuffer(id, [](GLuint f) { glDeleteFramebuffers(1, &f); });
  if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw job_error("the OpenGL driver cannot draw into the textures the renderer needs");
  return framebuffer;
}

Object make_program(std::string_view vertex_shader, std::string_view fragment_shader) {
  Object program(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); });
  const Object vertex = compile(GL_VERTEX_SHADER, vertex_shader);
  glAttachShader(program.id(), vertex.id());
  Object fragment;
  if (!fragment_shader.empty()) {
    fragment = compile(GL_FRAGMENT_SHADER, fragment_shader);
    glAttachShader(program.id(), fragment.id());
  }
  glLinkProgram(program.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw job_error("the OpenGL driver cannot link a program: " + log);
}

}  // namespace talus::gl
