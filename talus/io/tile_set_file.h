// Tile sets in the project's own format, for caches and for giving away.
//
// Little endian: "TALUSTIL", version (u32), body size (u64), body, digest of the body (32 hex
// digits). The body holds parameters, seed, distinct meshes, stones, runs and statistics, in the
// order of the fields of `TileSet`.
#pragma once

#include <filesystem>
#include <string_view>

#include "talus/rocks/tile_set.h"

namespace talus {

// Throws `Error` (job) if the file cannot be written.
void save_tile_set(const std::filesystem::path& path, const TileSet& tiles);

// The set that was saved, bit for bit, meshes shared as they were. Throws `Error` (input) for a
// missing file, another version, any truncation and any changed byte, and for contents that no tile
// set has.
TileSet load_tile_set(const std::filesystem::path& path);

// Whether these are the first bytes of a tile set file; whether that is what lies at a path.
bool is_tile_set(std::string_view bytes);
bool is_tile_set_file(const std::filesystem::path& path);

}  // namespace talus
