// How large the stones of tile sets are, what shapes they have, and how many others they touch.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "talus/rocks/tile_set.h"

namespace talus {

struct Spread {
  double min = 0, mean = 0, max = 0;
};

// With the long, middle and short measure a >= b >= c of a stone along its axes of inertia.
struct StoneStatistics {
  Spread volume;               // in cubic cells
  Spread equivalent_diameter;  // of the ball of the same volume, in cells
  Spread flatness;             // c / b
  Spread elongation;           // b / a
  Spread sphericity;           // area of that ball's surface over the stone's ([Wadell1935])

  // Shares by [Zingg1935]: b / a and c / b above or below two thirds.
  double equant = 0;  // both above
  double discs = 0;   // c / b below
  double rods = 0;    // b / a below
  double blades = 0;  // both below

  // Entry i is the share of stones that keep i contacts, as far as they know by themselves.
  std::vector<double> contacts;
};

// Means over what the sets' tilings contain, where stones are as frequent as the colorings they
// depend on; zeros if there are none. Stones that are empty do not count.
StoneStatistics stone_statistics(std::span<const std::shared_ptr<const TileSet>> sets);

}  // namespace talus
