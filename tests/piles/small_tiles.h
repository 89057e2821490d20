// Tile sets that are made in no time.
#pragma once

#include <memory>

#include "talus/rocks/tile_set.h"

namespace talus::test {

// One stone in a cell, or up to four.
inline std::shared_ptr<const TileSet> small_tiles(int seeds_max = 1) {
  static const auto make = [](int seeds) {
    return std::make_shared<const TileSet>(
        TileSet::make({.n = 5, .voxels_per_edge = seeds > 1 ? 40 : 20, .seeds_max = seeds}, 1));
  };
  static const auto one = make(1), several = make(4);
  return seeds_max > 1 ? several : one;
}

}  // namespace talus::test
