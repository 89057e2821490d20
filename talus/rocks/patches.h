// Where the stones of a block meet.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <span>
#include <vector>

#include "talus/rocks/colors.h"

namespace talus::rocks {

struct Block;
struct BlockType;

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

// A block next to another along an axis, on a cube that lies `cube` from the other's.
struct AdjacentBlock {
  const Block* block;
  int axis;
  Int3 cube;
};

// The patches of the faces that belong to a block, see `BlockFaces`.
BlockPatches find_patches(const Block& block, const BlockType& type,
                          std::span<const AdjacentBlock> adjacent, const CellLayout& layout);

}  // namespace talus::rocks
