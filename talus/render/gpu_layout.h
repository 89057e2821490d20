// What the shaders read from buffers.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "talus/base/vec.h"

namespace talus {

// As `Instance` in shaders/common.glsl.
struct GpuInstance {
  Vec3f position;
  float scale;
  glm::vec4 rotation;  // x, y, z, w
  Vec3f albedo;
  float texture_scale;  // see shaders/common.glsl
  Vec3f texture_offset;
  std::uint32_t id;  // from 1
};

struct DrawCommand {  // as OpenGL defines it
  std::uint32_t count;
  std::uint32_t instance_count;
  std::uint32_t first_index;
  std::int32_t base_vertex;
  std::uint32_t base_instance;
};

}  // namespace talus
