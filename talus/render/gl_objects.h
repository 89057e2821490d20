// Ownership of OpenGL objects, and what OpenGL complains about. Needs a current context, also for
// destruction.
#pragma once

#include <epoxy/gl.h>

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace talus::gl {

class Object {
 public:
  using Delete = void (*)(GLuint);

  Object() = default;
  Object(GLuint id, Delete destroy) : id_(id), destroy_(destroy) {}
  ~Object() {
    if (id_ != 0) destroy_(id_);
  }
  Object(Object&& other) noexcept
      : id_(std::exchange(other.id_, 0)), destroy_(std::exchange(other.destroy_, nullptr)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }

  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
  Delete destroy_ = nullptr;
};

// Keeps the first error that OpenGL reports while it lives.
class ErrorLog {
 public:
  ErrorLog();
  ~ErrorLog();
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;

  // Throws `Error` (job) if there was one.
  void check() const;

 private:
  std::string first_;
};

Object make_buffer(const void* data, std::size_t size);
template <class T>
Object make_buffer(std::span<const T> values) {
  return make_buffer(values.data(), values.size_bytes());
}
// Whose contents `update_buffer` replaces, size and all.
Object make_changing_buffer();
void update_buffer(const Object& buffer, const void* data, std::size_t size);
template <class T>
void update_buffer(const Object& buffer, std::span<const T> values) {
  update_buffer(buffer, values.data(), values.size_bytes());
}
Object make_vertex_array();
// For vertices, so many bytes apart, that begin with a position and a normal in 10 bits an axis
// (attributes 0 and 1), drawn by their indices, with one number for each instance (attribute 2).
Object make_surface_array(const Object& vertices, GLsizei stride, const Object& indices,
                          const Object& picks);
// Draws triangles by commands with the bound program.
void draw_commands(const Object& vertex_array, const Object& commands, std::size_t count);
// With `levels` above 1 the texture repeats and is filtered; else it is read texel by texel.
Object make_texture(GLenum format, int width, int height, int levels = 1);
// As `make_texture`, `layers` of them.
Object make_texture_array(GLenum format, int size, int layers, int levels = 1);
// A depth texture, read as the share of neighboring texels that are not nearer than a given depth.
void compare_depths(const Object& texture);
// `depth` may be 0.
Object make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth);
// Without targets; layers of texture arrays are attached as they are drawn.
Object make_framebuffer();
// Puts the common text before both; each comes in parts, the fragment shader may have none. Throws
// `Error` (job) with the compiler's words.
Object make_program(std::initializer_list<std::string_view> vertex_shader,
                    std::initializer_list<std::string_view> fragment_shader);

}  // namespace talus::gl
