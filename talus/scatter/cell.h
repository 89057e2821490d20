// Voronoi cells of sites, and whether two cells meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "talus/scatter/site_set.h"

namespace talus::scatter {

// A convex polygon with whole coordinates: corners relative to the site, counterclockwise, strictly
// convex.
struct Cell {
  Point site;
  std::vector<Point> corners;
};

// The Voronoi cell of a site, cut by the bounds. The set must hold every site within twice its
// distance, and no point of the plane (of the bounds) may be as far as the distance from all of the
// plane's (the bounds') sites. Corners are rounded to whole coordinates towards the site, by less
// than 5 steps, so that cells lie inside the exact ones and never overlap.
Cell voronoi_cell(const SiteSet& sites, std::size_t site, const std::optional<Rect>& bounds);

// What is left of a cell on its site's side of a line along an edge of another, of which it stays
// off. The edge is the one that the site is farthest outside of; none if it is outside of none, or
// if nothing is left.
std::optional<Cell> cut_off(const Cell& cell, const Cell& other);

// Exact.
std::int64_t twice_area(const Cell& cell);

// Of its border, in steps.
double perimeter(const Cell& cell);

// Whether the insides of two cells have a point in common; exact. Their sites may be up to 2^27
// apart along x and y.
bool cells_meet(const Cell& a, const Cell& b);

// Whether the point lies inside the cell, off its border; exact.
bool inside(const Cell& cell, const Point& p);

}  // namespace talus::scatter
