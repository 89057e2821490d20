#include "talus/render/gl_objects.h"

#include <array>
#include <string>
#include <vector>

#include "talus/base/error.h"
#include "talus/render/shaders.h"

namespace talus::gl {

namespace {

Object compile(GLenum stage, std::initializer_list<std::string_view> parts) {
  Object shader(glCreateShader(stage), [](GLuint id) { glDeleteShader(id); });
  std::vector<const char*> texts = {shaders::common_glsl.data()};
  std::vector<GLint> lengths = {static_cast<GLint>(shaders::common_glsl.size())};
  for (const std::string_view part : parts) {
    texts.push_back(part.data());
    lengths.push_back(static_cast<GLint>(part.size()));
  }
  glShaderSource(shader.id(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
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

Object make_changing_buffer() {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  return {id, [](GLuint b) { glDeleteBuffers(1, &b); }};
}

void update_buffer(const Object& buffer, const void* data, std::size_t size) {
  glNamedBufferData(buffer.id(), static_cast<GLsizeiptr>(size), data, GL_STREAM_DRAW);
}

Object make_vertex_array() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return {id, [](GLuint a) { glDeleteVertexArrays(1, &a); }};
}

Object make_surface_array(const Object& vertices, GLsizei stride, const Object& indices,
                          const Object& picks) {
  Object vertex_array = make_vertex_array();
  const GLuint array = vertex_array.id();
  glVertexArrayElementBuffer(array, indices.id());
  glVertexArrayVertexBuffer(array, 0, vertices.id(), 0, stride);
  glVertexArrayVertexBuffer(array, 1, picks.id(), 0, sizeof(GLuint));
  glVertexArrayBindingDivisor(array, 1, 1);
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribFormat(array, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, 3 * sizeof(GLfloat));
  glVertexArrayAttribIFormat(array, 2, 1, GL_UNSIGNED_INT, 0);
  for (const GLuint attribute : {0u, 1u, 2u}) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, attribute == 2 ? 1 : 0);
  }
  return vertex_array;
}

void draw_commands(const Object& vertex_array, const Object& commands, std::size_t count) {
  if (count == 0) return;
  glBindVertexArray(vertex_array.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(count),
                              0);
}

namespace {

void set_filter(GLuint id, bool filtered) {
  const auto wrap = filtered ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, wrap);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, wrap);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, filtered ? GL_LINEAR : GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, filtered ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
}

}  // namespace

Object make_texture(GLenum format, int width, int height, int levels) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  glTextureStorage2D(id, levels, format, width, height);
  set_filter(id, levels > 1);
  return {id, [](GLuint t) { glDeleteTextures(1, &t); }};
}

Object make_texture_array(GLenum format, int size, int layers, int levels) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
  glTextureStorage3D(id, levels, format, size, size, layers);
  set_filter(id, levels > 1);
  return {id, [](GLuint t) { glDeleteTextures(1, &t); }};
}

void compare_depths(const Object& texture) {
  glTextureParameteri(texture.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(texture.id(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

Object make_framebuffer() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return {id, [](GLuint f) { glDeleteFramebuffers(1, &f); }};
}

Object make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth) {
  Object framebuffer = make_framebuffer();
  const GLuint id = framebuffer.id();
  std::vector<GLenum> targets;
  for (const GLuint color : colors) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    glNamedFramebufferTexture(id, targets.back(), color, 0);
  }
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(targets.size()), targets.data());
  if (depth != 0) glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth, 0);
  if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw job_error("the OpenGL driver cannot draw into the textures the renderer needs");
  return framebuffer;
}

Object make_program(std::initializer_list<std::string_view> vertex_shader,
                    std::initializer_list<std::string_view> fragment_shader) {
  Object program(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); });
  const Object vertex = compile(GL_VERTEX_SHADER, vertex_shader);
  glAttachShader(program.id(), vertex.id());
  Object fragment;
  if (fragment_shader.size() > 0) {
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
