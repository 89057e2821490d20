// Meshes in the graphics card's memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/mesh/triangle_mesh.h"
#include "talus/render/gl_objects.h"
#include "talus/render/sight.h"

namespace talus {

// A mesh and where it is drawn.
struct PlacedMesh {
  const TriangleMesh* mesh = nullptr;
  Vec3 position{0};
  double scale = 1;
  std::uint32_t instance = 0;  // its number in the instance buffer
};

// Meshes in pieces, so that each draw takes only those in sight.
class MeshBuffers {
 public:
  explicit MeshBuffers(std::span<const PlacedMesh> meshes);

  // Draws with the bound program.
  void draw(const Sight& sight) const;

 private:
  struct Piece {
    Ball ball;
    std::uint32_t count;
    std::uint32_t first_index;
    std::int32_t base_vertex;
    std::uint32_t mesh;
  };

  std::vector<Piece> pieces_;
  gl::Object vertices_;
  gl::Object indices_;
  gl::Object picks_;  // number of each mesh in the instance buffer
  gl::Object commands_;
  gl::Object vertex_array_;
};

}  // namespace talus
