// Throwing sites until no place is left.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/scatter/plane.h"

namespace talus::scatter {

// New sites in the area, beside those that are there: at random among the points that keep the
// distance from every site, until there is no such point. With the others they are a maximal
// Poisson-disk set, exactly, in whole coordinates. Darts go only where place may be left, to
// squares that are halved as they are covered, which leaves all free points the odds that darts
// thrown everywhere give them ([Ebeida2012]).
//
// Depends on what is given alone; sites farther than the distance from the area do not matter. The
// area is at most 2^28 wide and high, the distance at most 2^26.
std::vector<Point> throw_darts(const Rect& area, std::int64_t distance, std::uint64_t key,
                               const std::vector<Point>& there = {});

}  // namespace talus::scatter
