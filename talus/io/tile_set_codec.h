// Turns tile sets into bytes and back, behind files and digests.
#pragma once

#include <string>
#include <string_view>

#include "talus/rocks/tile_set.h"

namespace talus {

class TileSetCodec {
 public:
  // The body of a tile set file; the same set gives the same bytes.
  static std::string encode(const TileSet& tiles);
  // Throws `Error` (input), without a file name, unless the bytes are those of a sound tile set.
  static TileSet decode(std::string_view bytes);
};

}  // namespace talus
