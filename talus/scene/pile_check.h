// Whether a pile holds together.
#pragma once

#include <cstdint>

#include "talus/piles/pile.h"

namespace talus {

struct PileCheck {
  std::uint64_t groups = 0;    // sets of stones joined by contacts that both stones keep
  std::uint64_t floating = 0;  // stones of groups that do not reach the pile's lowest cells
};

PileCheck check_pile(const Pile& pile);

}  // namespace talus
