// Where the seeds of a tile set lie in their cells.
#pragma once

#include <vector>

#include "talus/rocks/colors.h"

namespace talus::rocks {

// The random value that belongs to a cell with the colors it depends on.
std::uint64_t seed_key(std::uint64_t seed, const Int3& cell, std::uint32_t code);

// Places of the seeds of every cell (z, y, x), for all colors it depends on in order of their code:
// in cells from the cell's lower corner. Between `seeds_min` and `seeds_max` each, but that Poisson
// placement in a periodic set spreads as many over the whole cube.
std::vector<std::vector<Vec3>> place_seeds(const TileParams& params, std::uint64_t seed);

}  // namespace talus::rocks
