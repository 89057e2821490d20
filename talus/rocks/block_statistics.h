// What can be said about every tiling from the blocks that it is made of.
#pragma once

#include "talus/rocks/blocks.h"

namespace talus::rocks {

// The least distance between two seeds that can come next to each other, in cells; parallel.
double least_seed_spacing(const BlockTable& table);

}  // namespace talus::rocks
