// Where the stones of a block meet.
#pragma once

#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <span>
#include <vector>

#include "talus/rocks/colors.h"

namespace talus::rocks {

struct Block;
struct BlockType;

// Faces of a stone's voxels next to each other along x, towards voxels of one other stone.
struct FaceRun {
  std::int16_t x, y, z;       // middle of the first face, in half voxels
  std::uint16_t length : 13;  // at most the voxels along a cube's edge
  std::uint16_t axis : 2;
  std::uint16_t upwards : 1;  // along the axis

  Int3 middle() const { return {x, y, z}; }
  // The first voxels on either side: the stone's, and the other stone's.
  Int3 voxel() const { return beside(upwards ? -1 : 1); }
  Int3 beyond() const { return beside(upwards ? 1 : -1); }

 private:
  Int3 beside(int step) const {
    const Int3 along(axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0);
    return (middle() - 1 + along) >> 1;  // always even before
  }
};

// The faces between a stone and one other.
struct Patch {
  Int3 cell;  // the other's, relative to the block's cube
  std::uint16_t seed;
  bool known_to_both;  // whether the other's colors determine the block, too
  std::int64_t faces = 0;
  glm::i64vec3 sum{0};  // of their middles, in half voxels relative to the block's cube
  std::uint32_t first_run = 0;
  std::uint32_t end_run = 0;
  std::uint32_t first_face = 0;
};

// Voxels are relative to the block's cube.
struct BlockPatches {
  std::vector<FaceRun> runs;
  std::vector<float> distance_beyond;  // per face: the stone's distance across it, see StoneGrid
  std::vector<Patch> patches;
  std::vector<std::uint32_t>
      first;  // per candidate of the block its first patch; their number last

  std::span<const Patch> of(std::size_t candidate) const {
    return std::span(patches).subspan(first[candidate], first[candidate + 1] - first[candidate]);
  }
  std::span<const FaceRun> runs_of(const Patch& patch) const {
    return std::span(runs).subspan(patch.first_run, patch.end_run - patch.first_run);
  }
};

// A block next to another along an axis, on a cube that lies `cube` from the other's.
struct AdjacentBlock {
  const Block* block;
  int axis;
  Int3 cube;
};

// The patches between voxels of `block`, and between those and the voxels of `adjacent` blocks,
// seen from its candidates. Every face of a tiling thus belongs to one block: that of the voxel
// whose owner depends on more corners, the lower one of equals.
BlockPatches find_patches(const Block& block, const BlockType& type,
                          std::span<const AdjacentBlock> adjacent, const CellLayout& layout);

}  // namespace talus::rocks
