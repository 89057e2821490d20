#include "talus/rocks/tile_params.h"

namespace talus {

void validate_tiles(const TileParams& p) {
  validate(p, "tiles");
  const int per_cell = p.voxels() / p.n;
  if (p.voxels() % p.n != 0 || fixed_radius(p) * per_cell % 2 != 0) {
    const int step = fixed_radius(p) % 2 == 0 ? p.n : 2 * p.n;
    const int below = std::max(1, p.voxels() / step) * step;
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
  const int side = std::max(2 * fixed_radius(p) + 1, p.n - 2);
  if (static_cast<long>(side) * side * side * p.seeds_max > 65535)
    throw usage_error(
        fmt::format("tiles.seeds_max = {} is too many for n = {}: at most {} stones in a cell can "
                    "be told apart",
                    p.seeds_max, p.n, 65535 / (side * side * side)));
  if (p.contacts.blend < p.contacts.radius)
    throw usage_error(
        fmt::format("tiles.contacts.blend = {} cells is below tiles.contacts.radius = {} cells",
                    p.contacts.blend, p.contacts.radius));
}

}  // namespace talus
