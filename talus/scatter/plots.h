// Plots: the ground divided among stones to come, one convex polygon each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// Where one stone may lie. `key` is a hash of its place and class: whatever is random about the
// stone is drawn from it.
struct Plot {
  Vec2 site{0};
  std::uint64_t key = 0;
  std::uint32_t first_corner = 0;  // in `Plots::corners`
  std::uint16_t corner_count = 0;  // at least 3
  std::uint16_t size_class = 0;    // 0 is the largest
};

// Plots of one region. Corners are metres, world coordinates, counterclockwise, strictly convex;
// the insides of two plots never meet.
struct Plots {
  std::vector<Plot> plots;
  std::vector<Vec2> corners;

  std::span<const Vec2> corners_of(const Plot& plot) const {
    return std::span(corners).subspan(plot.first_corner, plot.corner_count);
  }
};

}  // namespace talus
