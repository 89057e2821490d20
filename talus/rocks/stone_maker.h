// From a place in a tile set to a finished stone.
#pragma once

#include <vector>

#include "talus/mesh/grid_bits.h"
#include "talus/mesh/grid_rows.h"
#include "talus/mesh/polygonize.h"
#include "talus/rocks/contacts.h"
#include "talus/rocks/stone_grid.h"
#include "talus/rocks/weathering.h"

namespace talus::rocks {

struct MadeStone {
  Stone stone;
  std::uint64_t fragment_voxels = 0;  // cut off by weathering and removed
  double reach = 0;                   // of its mesh beyond its cell, in cells
};

// Working memory of one thread; makes one stone after another.
class StoneMaker {
 public:
  StoneMaker(const TileParams& params, const BlockTable& blocks);

  MadeStone make(const StoneKey& key);

 private:
  // Fills `field_` with the stone's signed field: positive inside, at most 1 in magnitude.
  void compute_field(std::span<const float> wear);
  void meet_at(std::span<const Contact> contacts);
  // Leaves only the largest face-connected piece positive; returns the voxels it took away.
  std::uint64_t keep_largest_piece();
  StoneSolid solid() const;
  // Sets the stone's mesh and what is measured on it, from the field; `first_sample` is relative to
  // the pivot, in voxels.
  void add_mesh(const Vec3f& first_sample, MadeStone& made);

  const BlockTable& blocks_;
  double voxel_size_;  // in cells
  StoneGrid grid_;
  ContactFinder contact_finder_;
  Weathering weathering_;
  PolygonizeScratch polygonize_scratch_;
  std::vector<float> field_;
  std::vector<std::uint8_t> inside_;  // 1 where the field is positive
  GridBits bits_;
  GridRows rows_;  // where the field is positive
};

}  // namespace talus::rocks
