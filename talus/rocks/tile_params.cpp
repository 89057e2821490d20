#include "talus/rocks/tile_params.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace talus {
namespace {

// Cells in the blocks of all types, of which there is one for every coloring of its corners.
double count_block_cells(const TileParams& p) {
  const int around = 1 + fixed_radius(p), between = p.n - 2 - fixed_radius(p);
  double total = 0;
  for (int type = 0; type < 8; ++type) {
    double cells = 1;
    int corners = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_between = (type >> axis & 1) != 0;
      if (repeats(p.variety, axis))
        cells *= is_between ? 0 : p.n - 1;
      else
        cells *= is_between ? between : around;
      corners *= 1 + is_between;
    }
    total += cells * (p.variety == Variety::periodic ? 1 : std::pow(p.colors, corners));
  }
  return total;
}

}  // namespace

void validate_tiles(const TileParams& p) {
  validate(p, "tiles");
  const int per_cell = p.voxels() / p.n;
  // Where corners are colored, intervals end half a cell from cells' bounds if R is odd.
  const bool needs_halves = p.variety != Variety::periodic && fixed_radius(p) % 2 != 0;
  if (p.voxels() % p.n != 0 || (needs_halves && per_cell % 2 != 0)) {
    const int step = needs_halves ? 2 * p.n : p.n;
    const int below = std::max((4 * p.n + step - 1) / step, p.voxels() / step) * step;
    throw usage_error(fmt::format(
        "tiles.voxels_per_edge = {} does not divide a cube of n = {} cells evenly; it must be a "
        "multiple of {}, for example {} or {}",
        p.voxels(), p.n, step, below, below + step));
  }
  if (per_cell < 4)
    throw usage_error(fmt::format(
        "tiles.voxels_per_edge = {} leaves {} voxels to a cell of n = {}; give at least {}",
        p.voxels(), per_cell, p.n, 4 * p.n));
  if (p.seeds_min > p.seeds_max)
    throw usage_error(fmt::format("tiles.seeds_min = {} is above tiles.seeds_max = {}", p.seeds_min,
                                  p.seeds_max));
  // Blocks of every type, as BlockTable holds them at its peak: two distances a voxel; runs and
  // faces of stones, which are as many as stones along a line; what is kept for each stone.
  constexpr double kMaxBytes = 6e9;
  const double stones = p.seeds_max / std::pow(per_cell, 3);  // in a voxel
  const double bytes_per_voxel = 8 + 150 * std::cbrt(stones) + 2500 * stones;
  const double voxels = count_block_cells(p) * std::pow(per_cell, 3);
  if (voxels * bytes_per_voxel > kMaxBytes)
    throw usage_error(fmt::format(
        "tiles of n = {}, {} colors, {} voxels per edge and up to {} stones in a cell "
        "take {:.0f} GB; lower one of them, at most {:.0f} GB are possible",
        p.n, p.colors, p.voxels(), p.seeds_max, voxels * bytes_per_voxel * 1e-9, kMaxBytes * 1e-9));
  if (!(glm::length(p.bedding) > 0))
    throw usage_error("tiles.bedding = [0, 0, 0] is no direction; [0, 0, 1] makes level beds");
  if (p.contacts.blend < p.contacts.radius)
    throw usage_error(
        fmt::format("tiles.contacts.blend = {} cells is below tiles.contacts.radius = {} cells",
                    p.contacts.blend, p.contacts.radius));
}

}  // namespace talus
