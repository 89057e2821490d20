// What the tile sets of a scene are like.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "talus/rocks/stone_statistics.h"
#include "talus/rocks/tile_set.h"

namespace talus {

// With more than one tile set, counts are summed and shares are means over their stones.
struct TileReport {
  std::string variety;  // of the first tile set, like the next three
  std::uint64_t seed = 0;
  int n = 0;
  int voxels_per_edge = 0;
  std::uint64_t unique = 0;
  std::uint64_t distinct_meshes = 0;
  std::uint64_t empty = 0;
  std::uint64_t voxels = 0;             // of the stones before they weather
  std::uint64_t fragments_removed = 0;  // voxels that weathering had cut off
  double seed_spacing_cells = 0;        // the least of any
  double deviation_bound_percent = 0;   // of space; the most of any
  double void_fraction = 0;
  double contacts_mean = 0;
  std::uint64_t contacts_min = 0;
  double contacts_lost_fraction = 0;
  double below_three_fraction = 0;
  StoneStatistics stones;
};

// At least one tile set.
TileReport report_tiles(std::span<const std::shared_ptr<const TileSet>> sets);

std::string to_json(const TileReport& report);

}  // namespace talus
