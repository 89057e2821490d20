// Turns tile sets into bytes and back, behind files and digests.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "talus/rocks/tile_set.h"

namespace talus {

class TileSetCodec {
 public:
  using Sink = std::function<void(std::string_view)>;

  // Hands the body of a tile set file on, piece by piece, since it may take hundreds of megabytes.
  // The same set gives the same bytes.
  static void write(const TileSet& tiles, const Sink& sink);
  // How many bytes that are.
  static std::uint64_t size(const TileSet& tiles);
  // Throws `Error` (input), without a file name, unless the bytes are those of a sound tile set.
  static TileSet decode(std::string_view bytes);

 private:
  template <class Archive>
  static void list(Archive& out, const TileSet& tiles);
};

}  // namespace talus
