#include "talus/scatter/cell.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/vec.h"

namespace talus::scatter {
namespace {

// Twice the area of the triangle a, b, c; positive when counterclockwise.
std::int64_t orientation(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The points p with dot(normal, p) <= bound.
struct HalfPlane {
  Vec2 normal;
  double bound;
};

// Keeps what lies in the half-plane.
void cut(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, const HalfPlane& half) {
  const auto beyond = [&](const Vec2& p) { return glm::dot(half.normal, p) - half.bound; };
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = beyond(a), to = beyond(b);
    if (from <= 0) scratch.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0))
      scratch.push_back(a + from / (from - to) * (b - a));
  }
  polygon.swap(scratch);
}

// Corners of the convex hull, counterclockwise (Andrew's monotone chain).
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), by_place);
  std::vector<Point> hull;
  hull.reserve(2 * points.size());
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && orientation(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // begins the other chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

// Scaled, rounded to whole coordinates.
std::vector<Point> rounded_hull(const std::vector<Vec2>& polygon, double scale) {
  std::vector<Point> corners;
  corners.reserve(polygon.size());
  for (const Vec2& p : polygon)
    corners.push_back({std::llround(scale * p.x), std::llround(scale * p.y)});
  return convex_hull(std::move(corners));
}

// Whether a line through an edge of `a` has all of `b` on its outer side.
bool edge_separates(const Cell& a, const Cell& b) {
  const Point shift{b.site.x - a.site.x, b.site.y - a.site.y};
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    const Point &from = a.corners[i], &to = a.corners[(i + 1) % a.corners.size()];
    bool outside = true;
    for (std::size_t j = 0; outside && j < b.corners.size(); ++j)
      outside = orientation(from, to, {b.corners[j].x + shift.x, b.corners[j].y + shift.y}) <= 0;
    if (outside) return true;
  }
  return false;
}

}  // namespace

Cell voronoi_cell(const SiteSet& sites, std::size_t site, const std::optional<Rect>& bounds) {
  const Point& center = sites[site];
  const std::int64_t d = sites.distance();
  std::vector<Point> neighbors;
  sites.any_near(Rect{center, {center.x + 1, center.y + 1}}.expanded(2 * d), [&](std::size_t i) {
    if (i != site && squared_distance(sites[i], center) < 4 * d * d) neighbors.push_back(sites[i]);
    return false;
  });
  // In an order that does not depend on the set.
  std::sort(neighbors.begin(), neighbors.end(), by_place);

  // No corner of the cell is as far from the site as the distance.
  const auto relative = [&](const Point& p) { return Vec2(p.x - center.x, p.y - center.y); };
  Rect reach = Rect{center, center}.expanded(d);
  if (bounds) reach = reach.intersected(*bounds);
  std::vector<Vec2> polygon{relative(reach.lo), relative({reach.hi.x, reach.lo.y}),
                            relative(reach.hi), relative({reach.lo.x, reach.hi.y})};
  std::vector<Vec2> scratch;
  for (const Point& neighbor : neighbors) {
    const Vec2 to = relative(neighbor);
    cut(polygon, scratch, {to, 0.5 * glm::dot(to, to)});
  }

  // Other cells begin at half the distance at least, so this takes corners two steps and more away
  // from them. Rounding cannot take them back, nor out of the bounds.
  return {center, rounded_hull(polygon, 1 - 4 / static_cast<double>(d))};
}

std::optional<Cell> cut_off(const Cell& cell, const Cell& other) {
  const Vec2 shift(other.site.x - cell.site.x, other.site.y - cell.site.y);
  HalfPlane farthest{.normal = Vec2(0), .bound = 0};
  for (std::size_t i = 0; i < other.corners.size(); ++i) {
    const Point &from = other.corners[i], &to = other.corners[(i + 1) % other.corners.size()];
    const Vec2 inward = glm::normalize(Vec2(from.y - to.y, to.x - from.x));
    const double bound = glm::dot(inward, Vec2(from.x, from.y) + shift);
    if (bound > farthest.bound) farthest = {inward, bound};
  }
  farthest.bound -= 2;  // so that rounding stays off the other
  if (farthest.bound <= 0) return {};

  std::vector<Vec2> polygon, scratch;
  for (const Point& corner : cell.corners) polygon.emplace_back(corner.x, corner.y);
  cut(polygon, scratch, farthest);
  if (polygon.size() < 3) return {};
  Cell rest{cell.site, rounded_hull(polygon, 1)};
  if (rest.corners.size() < 3) return {};
  return rest;
}

std::int64_t twice_area(const Cell& cell) {
  std::int64_t sum = 0;
  for (std::size_t i = 2; i < cell.corners.size(); ++i)
    sum += orientation(cell.corners[0], cell.corners[i - 1], cell.corners[i]);
  return sum;
}

double perimeter(const Cell& cell) {
  double sum = 0;
  for (std::size_t i = 0; i < cell.corners.size(); ++i) {
    const Point &a = cell.corners[i], &b = cell.corners[(i + 1) % cell.corners.size()];
    sum += std::sqrt(static_cast<double>(squared_distance(a, b)));
  }
  return sum;
}

bool cells_meet(const Cell& a, const Cell& b) {
  return !edge_separates(a, b) && !edge_separates(b, a);
}

bool inside(const Cell& cell, const Point& p) {
  const Point relative{p.x - cell.site.x, p.y - cell.site.y};
  for (std::size_t i = 0; i < cell.corners.size(); ++i)
    if (orientation(cell.corners[i], cell.corners[(i + 1) % cell.corners.size()], relative) <= 0)
      return false;
  return true;
}

}  // namespace talus::scatter
