// A stone's mesh with everything its material needs.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "talus/mesh/triangle_mesh.h"

namespace talus {

struct DressedMesh {
  TriangleMesh mesh;  // with normals, vertices split at texture seams
  std::vector<glm::vec2> texture_coordinates;
  std::vector<std::array<std::uint8_t, 4>> colors;  // linear RGBA
};

// Lightness and a touch of warm or cool, drawn per stone: linear red, green, blue.
Vec3f stone_tint(std::uint64_t seed, std::uint32_t stone);

// Projects a texture along the axis that each triangle faces most, about 1.3 repeats a unit, from a
// random offset so that the least coordinates lie between 0 and 1; where neighbours face different
// axes their vertices are doubled at bit-equal positions. Colors are one tint per stone, lighter on
// edges and darker in hollows. `stone` and `seed` choose offset and tint. Missing normals are
// computed.
DressedMesh dress(const TriangleMesh& mesh, std::uint64_t seed, std::uint32_t stone);

}  // namespace talus
