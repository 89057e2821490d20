// Throwing sites until no place is left.
#pragma once

#include <cstdint>

#include "talus/scatter/site_set.h"

namespace talus::scatter {

// Adds sites of `area` to the set, at random among those points that keep its distance from every
// site, until there is no such point: a maximal Poisson-disk set, exactly, in the grid's steps.
// Darts go only where place may be left, to squares that are halved as they are covered, which
// leaves the odds of every free point as with darts thrown everywhere ([Ebeida2012]). Depends on
// the sites there are and on `key` alone. The area must lie in the set's.
void throw_darts(const Rect& area, std::uint64_t key, SiteSet& sites);

}  // namespace talus::scatter
