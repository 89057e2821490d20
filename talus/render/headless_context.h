// OpenGL without a display.
#pragma once

#include <memory>
#include <string>

namespace talus {

// An OpenGL 4.5 core context that draws into no window, current on this thread while it lives.
// Needs EGL and a driver for its surfaceless platform; Mesa's software rasterizer is enough.
class HeadlessContext {
 public:
  // Throws `Error` (job) if no such context can be had.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  // As the driver describes itself, for example "4.5 (Core Profile) Mesa 22.3.6".
  std::string version() const;
  // Major and minor version as one number: 45 for OpenGL 4.5.
  int version_number() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace talus
