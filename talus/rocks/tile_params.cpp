#include "talus/rocks/tile_params.h"

#include <algorithm>
#include <cmath>

namespace talus {

void validate_tiles(const TileParams& p) {
  validate(p, "tiles");
  const int per_cell = p.voxels() / p.n;
  if (p.voxels() % p.n != 0 || fixed_radius(p) * per_cell % 2 != 0) {
    const int step = fixed_radius(p) % 2 == 0 ? p.n : 2 * p.n;
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
  double voxels = 0;
  for (int between = 0; between <= 3; ++between) {
    const double a = 1 + fixed_radius(p), b = p.n - 2 - fixed_radius(p);
    constexpr int kTypes[] = {1, 3, 3, 1};
    voxels += kTypes[between] * std::pow(a, 3 - between) * std::pow(b, between) *
              std::pow(per_cell, 3) * std::pow(p.colors, 1 << between);
  }
  if (voxels * bytes_per_voxel > kMaxBytes)
    throw usage_error(fmt::format(
        "tiles of n = {}, {} colors, {} voxels per edge and up to {} stones in a cell "
        "take {:.0f} GB; lower one of them, at most {:.0f} GB are possible",
        p.n, p.colors, p.voxels(), p.seeds_max, voxels * bytes_per_voxel * 1e-9, kMaxBytes * 1e-9));
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
