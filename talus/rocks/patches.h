// Where the stones of a block meet.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <span>
#include <vector>

#include "talus/rocks/colors.h"

namespace talus::rocks {

// A stone as far as a block is concerned.
struct Party {
  Int3 cell;  // relative to the block's cube
  std::uint16_t seed;
};

// The faces between two stones whose colors both determine the block.
struct Patch {
  std::array<Party, 2> parties;
  std::uint32_t first_face, end_face;
  glm::i64vec3 sum{0};  // of the faces' middles
};

struct BlockPatches {
  // By axis: middles of voxel faces, in half voxels relative to the block's cube; even across a
  // face.
  std::array<std::vector<std::int16_t>, 3> faces;
  std::vector<Patch> patches;
  // One side of a patch.
  struct Side {
    std::uint32_t patch;
    std::uint32_t other;  // which of its parties lies across
  };
  std::vector<Side> sides;
  std::vector<std::uint32_t> first;  // per candidate of the block its first side; their number last

  std::span<const Side> of(std::size_t candidate) const {
    return std::span(sides).subspan(first[candidate], first[candidate + 1] - first[candidate]);
  }
};

// A face between two stones whose colors both determine the block.
struct SharedFace {
  std::uint32_t first, second;  // parties, first < second
  glm::i16vec3 middle;          // in half voxels relative to the block's cube
};

// The patches of a block's faces, which are sorted by it. The block's candidates are the first
// parties.
BlockPatches find_patches(std::span<const Party> parties, std::size_t candidates,
                          std::vector<SharedFace>& faces);

}  // namespace talus::rocks
