// Painted masks.
#pragma once

#include <filesystem>

#include "talus/tools/brush.h"

namespace talus {

// A picture as a mask, a pixel for each column, north up: black is 0, white 1; of a colored one the
// mean of red, green and blue, without alpha. Throws as `read_image`, and `Error` (usage) if it is
// not nx x ny pixels, before these are read.
ColumnMask read_mask(const std::filesystem::path& path, int nx, int ny);
// The same of a picture of any size.
ColumnMask read_mask(const std::filesystem::path& path);

}  // namespace talus
