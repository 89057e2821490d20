// Stones of a tile set side by side, to see what they are like.
#pragma once

#include "talus/mesh/instance_table.h"
#include "talus/rocks/tile_set.h"

namespace talus {

// Up to `count` stones of different shape, evenly chosen among all, largest first, in rows on the
// plane z = 0. Each lies on its broadest side, its longest along x; lengths are in cells.
InstanceTable specimens(const TileSet& tiles, int count);

}  // namespace talus
