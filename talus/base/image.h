// An 8-bit picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace talus {

// Rows from top to bottom, pixels from left to right, `channels` bytes each (1 grey, 3 RGB,
// 4 RGBA), sRGB unless said otherwise.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;
};

}  // namespace talus
