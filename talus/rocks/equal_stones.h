// Which stones of a set are the same stone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/rocks/stone_grid.h"

namespace talus::rocks {

// For every stone the index of the first one that is equal to it, itself if there is none before.
// Equal stones lie in the same cell, grow from the same seed, and own the same voxels at the same
// distances, with the same neighbors behind every face: all that is made of stones depends on no
// more. Most differ only in colors of corners that are too far away to matter.
std::vector<std::uint32_t> find_equal_stones(const BlockTable& blocks,
                                             std::span<const StoneKey> stones);

}  // namespace talus::rocks
