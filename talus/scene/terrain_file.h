// A terrain after one operation, as the cache keeps it.
#pragma once

#include <filesystem>

#include "talus/terrain/layered_terrain.h"

namespace talus {

// What an operation made of a terrain.
struct TerrainStage {
  LayeredTerrain terrain;
  Booking booking;
  bool balanced = false;  // volumes before and after differ by exactly what was booked
};

// Throws `Error` (job).
void save_terrain(const std::filesystem::path& path, const TerrainStage& stage);

// Throws `Error` (input) if the file is missing, cut off or changed by a single bit.
TerrainStage load_terrain(const std::filesystem::path& path);

}  // namespace talus
