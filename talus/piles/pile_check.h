// Whether a pile holds together.
#pragma once

#include <cstdint>

#include "talus/piles/pile.h"

namespace talus {

// Of the stones that lie where the tiling has them.
struct PileCheck {
  std::uint64_t groups = 0;  // sets of stones joined by contacts that both stones keep
  std::uint64_t floating =
      0;                     // stones of groups that do not reach the lowest cells above the floor
  double contacts_mean = 0;  // per stone
};

PileCheck check_pile(const Pile& pile);

}  // namespace talus
