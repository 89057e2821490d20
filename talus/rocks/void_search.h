// The depth of weathering that leaves a given share of space between stones.
#pragma once

#include <span>

#include "talus/rocks/stone_grid.h"

namespace talus {
class Job;
}

namespace talus::rocks {

// `params` with the `depth` that reaches its `void_fraction`, or comes as near to it as any; found
// by halving, on a sample of the stones, to about a hundredth of space. Warns of what cannot be
// reached. Returns `params` if they ask for none.
TileParams with_depth_for_voids(const TileParams& params, const BlockTable& blocks,
                                std::span<const StoneKey> stones, Job* job);

}  // namespace talus::rocks
