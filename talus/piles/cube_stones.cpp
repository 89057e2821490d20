#include "talus/piles/cube_stones.h"

#include <algorithm>

namespace talus::piles {

CubeStones::CubeStones(const TileSet& tiles) : tiles_(tiles), period_(tiles.params().n - 1) {}

void CubeStones::go_to(const Int3& cube) {
  tiles_.stones_of_cube(corner_colors(tiles_.params(), tiles_.seed(), cube), runs_);
  first_number_.resize(runs_.size() + 1);
  first_number_[0] = 0;
  for (std::size_t c = 0; c < runs_.size(); ++c)
    first_number_[c + 1] = first_number_[c] + runs_[c].count;
  one_each_ =
      std::all_of(runs_.begin(), runs_.end(), [](const auto& run) { return run.count == 1; });
}

std::size_t CubeStones::cell_of(std::uint32_t number) const {
  if (one_each_) return number;
  const auto next = std::upper_bound(first_number_.begin(), first_number_.end(), number);
  return static_cast<std::size_t>(next - first_number_.begin()) - 1;
}

std::size_t words_per_cube(const TileSet& tiles) {
  const int period = tiles.params().n - 1;
  std::vector<std::uint32_t> most(static_cast<std::size_t>(period * period * period));
  for (const Stone& stone : tiles.stones()) {
    std::uint32_t& seeds = most[static_cast<std::size_t>(
        stone.cell.x + period * (stone.cell.y + period * stone.cell.z))];
    seeds = std::max(seeds, std::uint32_t{stone.seed} + 1);
  }
  std::size_t stones = 0;
  for (const std::uint32_t seeds : most) stones += seeds;
  return std::max<std::size_t>(1, (stones + 63) / 64);
}

}  // namespace talus::piles
