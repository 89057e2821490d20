// Heights over a plan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace talus {

// One height at the center of each cell of nx x ny square cells, metres, row by row from the south,
// each row from the west. NaN where the height is unknown.
struct HeightGrid {
  int nx = 0;
  int ny = 0;
  double cell = 1;  // edge of a cell, metres
  std::vector<float> heights;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x);
  }
};

// None if no height is known.
inline std::optional<double> lowest_height(const HeightGrid& grid) {
  std::optional<double> lowest;
  for (const float height : grid.heights)
    if (std::isfinite(height)) lowest = std::min<double>(lowest.value_or(height), height);
  return lowest;
}

}  // namespace talus
