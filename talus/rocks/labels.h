// Who owns each voxel of a block.
#pragma once

#include "talus/rocks/blocks.h"

namespace talus::rocks {

// Fills in all of a block that follows from its candidates, but for its patches: by the rule of
// docs/rocks.md, the least d / phi owns a voxel, the first candidate of equals.
void label(Block& block);

}  // namespace talus::rocks
