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

constexpr double kMaxBytes = 6e9;

// Blocks of every type, as BlockTable holds them at its peak: owner, runner-up, clearance and,
// while it is labeled, distance of each voxel; faces of stones, which are as many as stones along a
// line; what is kept for each stone. Then the surroundings of a contact for each axis, see Damping.
double peak_bytes(const TileParams& p) {
  const double voxels_in_cell = std::pow(p.voxels() / p.n, 3);
  const double stones = p.seeds_max / voxels_in_cell;  // in a voxel
  const double bytes_per_voxel = 16 + 150 * std::cbrt(stones) + 2500 * stones;
  const double damped = std::max(p.contacts.blend, 2 * p.contacts.gaussian_radius.value_or(0));
  const double stencils = 3 * 2 * 8 * std::pow(damped, 3) * voxels_in_cell;
  return count_block_cells(p) * voxels_in_cell * bytes_per_voxel + stencils;
}

}  // namespace

bool fits_memory(const TileParams& params) { return peak_bytes(params) <= kMaxBytes; }

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
  if (!fits_memory(p))
    throw usage_error(fmt::format(
        "tiles of n = {}, {} colors, {} voxels per edge and up to {} stones in a cell "
        "take {:.0f} GB; lower one of them, at most {:.0f} GB are possible",
        p.n, p.colors, p.voxels(), p.seeds_max, peak_bytes(p) * 1e-9, kMaxBytes * 1e-9));
  if (glm::length(p.bedding) < 1e-6)
    throw usage_error(
        fmt::format("tiles.bedding = [{}, {}, {}] is no direction; [0, 0, 1] makes level beds",
                    p.bedding.x, p.bedding.y, p.bedding.z));
  // The bound on deviation has to look at all that a stone might reach.
  constexpr double kLargestRatio = 25;
  const double longest = std::max({p.axis_x.max, p.axis_y.max, p.axis_z.max});
  const double shortest = std::min({p.axis_x.min, p.axis_y.min, p.axis_z.min});
  if (longest > kLargestRatio * shortest)
    throw usage_error(fmt::format(
        "tiles.axis_x, axis_y and axis_z range from {} to {}; the longest may be {} times the "
        "shortest",
        shortest, longest, kLargestRatio));
  if (!p.contacts.gaussian_radius && p.contacts.blend < p.contacts.radius)
    throw usage_error(
        fmt::format("tiles.contacts.blend = {} cells is below tiles.contacts.radius = {} cells",
                    p.contacts.blend, p.contacts.radius));
}

}  // namespace talus
