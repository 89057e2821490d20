// Whether one stone of a tiling belongs to a pile.
#pragma once

#include "talus/field/support.h"
#include "talus/rocks/tile_set.h"

namespace talus::piles {

// A lattice of cells in the world: cell (0, 0, 0) has its lower corner at `origin`.
struct Lattice {
  Vec3 origin;
  double cell_size;

  Vec3 world(const Int3& cell, const Vec3& at) const {
    return origin + cell_size * (Vec3(cell) + at);
  }
};

// True if at least `fraction` of the stone's anchors, the centers of its solid's voxels and its
// seed, lie inside the support. Groups of voxels that lie wholly inside or outside are counted
// without asking for each; the answer is that of asking for each.
bool lies_inside(const Support& support, const Stone& stone, double voxel_size,
                 const Lattice& lattice, const Int3& cell, double fraction);

}  // namespace talus::piles
