// Stones in the graphics card's memory.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "talus/mesh/instance_table.h"
#include "talus/render/gl_objects.h"
#include "talus/render/gpu_layout.h"
#include "talus/render/sight.h"

namespace talus {

// A mesh for each prototype, and where stones are many also plainer ones for those that are small
// in the picture. Each draw takes only the stones that are in sight.
class StoneBuffers {
 public:
  // `balls` holds one ball per instance, in the space that is drawn in; it must outlive this.
  StoneBuffers(const InstanceTable& table, std::span<const Ball> balls);

  // Draws with the bound program; instance i is number i of the instance buffer.
  void draw(const Sight& sight) const;

 private:
  static constexpr std::size_t kDetails = 4;  // the mesh itself first
  struct MeshRange {
    std::uint32_t count;
    std::uint32_t first_index;
    std::int32_t base_vertex;
  };
  struct Run {  // of instances with the same mesh
    std::uint32_t begin;
    std::uint32_t end;
    std::array<MeshRange, kDetails> details;
  };

  std::span<const Ball> balls_;
  std::vector<Run> runs_;
  gl::Object vertices_;
  gl::Object indices_;
  gl::Object picks_;  // numbers of the instances to draw
  gl::Object commands_;
  gl::Object vertex_array_;
};

}  // namespace talus
