#include "talus/scatter/cell.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>

#include "talus/base/hash.h"
#include "talus/scatter/darts.h"

namespace talus::scatter {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false>;  // counterclockwise

BoostPolygon boost_polygon(const Cell& cell) {
  BoostPolygon polygon;
  for (const Point& p : cell.corners)
    bg::append(polygon, BoostPoint(double(cell.site.x + p.x), double(cell.site.y + p.y)));
  bg::append(polygon, polygon.outer().front());
  return polygon;
}

double shared_area(const Cell& a, const Cell& b) {
  std::vector<BoostPolygon> shared;
  bg::intersection(boost_polygon(a), boost_polygon(b), shared);
  double area = 0;
  for (const BoostPolygon& part : shared) area += bg::area(part);
  return area;
}

// Hulls of random points, with area. Coordinates are small, so that borders often touch.
class RandomCells {
 public:
  explicit RandomCells(std::uint64_t seed) : seed_(seed) {}

  Cell next() {
    Cell cell{{draw(8), draw(8)}, {}};
    while (cell.corners.size() < 3) {
      bg::model::multi_point<BoostPoint> points;
      for (int i = 0; i < 7; ++i) {
        const double x = static_cast<double>(draw(6)), y = static_cast<double>(draw(6));
        bg::append(points, BoostPoint(x, y));
      }
      BoostPolygon hull;
      bg::convex_hull(points, hull);
      cell.corners.clear();
      for (std::size_t i = 1; i < hull.outer().size() && bg::area(hull) > 0; ++i)
        cell.corners.push_back(
            {std::llround(hull.outer()[i].x()), std::llround(hull.outer()[i].y())});
    }
    return cell;
  }

 private:
  // From -most to most.
  std::int64_t draw(int most) {
    const double x = uniform(hash(seed_, Purpose::seed_position, count_++), -most, most + 1);
    return static_cast<std::int64_t>(std::floor(x));
  }

  std::uint64_t seed_;
  int count_ = 0;
};

RC_GTEST_PROP(Cells, MeetWhereBoostFindsSharedArea, (std::uint64_t seed)) {
  RandomCells cells(seed);
  for (int i = 0; i < 30; ++i) {
    const Cell a = cells.next(), b = cells.next();
    RC_ASSERT(cells_meet(a, b) == (shared_area(a, b) > 1e-9));
    RC_ASSERT(cells_meet(a, b) == cells_meet(b, a));
  }
}

RC_GTEST_PROP(Cells, HaveTheAreaAndTheInsideThatBoostSees, (std::uint64_t seed)) {
  const Cell cell = RandomCells(seed).next();
  const BoostPolygon polygon = boost_polygon(cell);
  RC_ASSERT(double(twice_area(cell)) == 2 * bg::area(polygon));
  RC_ASSERT(std::abs(perimeter(cell) - bg::perimeter(polygon)) < 1e-9);
  for (std::int64_t x = -15; x <= 15; ++x)
    for (std::int64_t y = -15; y <= 15; ++y)
      RC_ASSERT(inside(cell, {x, y}) == bg::within(BoostPoint(double(x), double(y)), polygon));
}

struct Sites {
  Rect area;
  SiteSet set;
};

Sites random_sites() {
  const std::int64_t d = *rc::gen::inRange(2'000, 1'000'000);
  const Rect area{{0, 0}, {12 * d, 9 * d}};
  Sites sites{area, SiteSet(area, d)};
  for (const Point& site : throw_darts(area, d, *rc::gen::arbitrary<std::uint64_t>()))
    sites.set.insert(site);
  return sites;
}

// Exact, for every site and every corner.
RC_GTEST_PROP(VoronoiCells, HaveEachCornerNearestToTheirOwnSite, ()) {
  const auto [area, sites] = random_sites();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Cell cell = voronoi_cell(sites, i, area);
    RC_ASSERT(cell.corners.size() >= 3);
    for (const Point& corner : cell.corners) {
      const Point p{cell.site.x + corner.x, cell.site.y + corner.y};
      RC_ASSERT(p.x >= 0 && p.y >= 0 && p.x <= area.hi.x && p.y <= area.hi.y);
      for (std::size_t j = 0; j < sites.size(); ++j)
        if (j != i) RC_ASSERT(squared_distance(p, sites[i]) < squared_distance(p, sites[j]));
    }
  }
}

RC_GTEST_PROP(VoronoiCells, AreThoseOfBoostButForTheRounding, ()) {
  const auto [area, sites] = random_sites();
  const std::int64_t d = sites.distance();
  std::vector<boost::polygon::point_data<int>> points;
  for (std::size_t i = 0; i < sites.size(); ++i)
    points.emplace_back(static_cast<int>(sites[i].x), static_cast<int>(sites[i].y));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);

  const Rect inner = area.expanded(-2 * d);
  for (const auto& expected : diagram.cells()) {
    const std::size_t i = expected.source_index();
    if (!inner.contains(sites[i])) continue;
    const Cell cell = voronoi_cell(sites, i, {});
    const auto* edge = expected.incident_edge();
    do {
      const auto* vertex = edge->vertex0();
      const bool found = std::any_of(cell.corners.begin(), cell.corners.end(), [&](const Point& p) {
        return std::hypot(double(cell.site.x + p.x) - vertex->x(),
                          double(cell.site.y + p.y) - vertex->y()) < 5;
      });
      RC_ASSERT(found);
      edge = edge->next();
    } while (edge != expected.incident_edge());
  }
}

RC_GTEST_PROP(CutOff, LeavesAPartOfTheCellThatStaysOffTheOther, ()) {
  const auto [area, sites] = random_sites();
  const Cell cell = voronoi_cell(sites, sites.size() / 2, area);
  // Another of about its size, somewhere near.
  Cell other = voronoi_cell(sites, sites.size() / 3, area);
  const int d = static_cast<int>(sites.distance());
  other.site = {cell.site.x + *rc::gen::inRange(-d, d), cell.site.y + *rc::gen::inRange(-d, d)};
  const auto rest = cut_off(cell, other);
  if (!rest) {
    // Only where the site is within a few steps of the other.
    Cell wider = other;
    for (Point& p : wider.corners) p = {p.x + p.x / 20, p.y + p.y / 20};
    RC_ASSERT(inside(wider, cell.site));
    return;
  }
  RC_ASSERT(!cells_meet(*rest, other));
  RC_ASSERT(shared_area(*rest, cell) > (1 - 1e-3) * bg::area(boost_polygon(*rest)));
  RC_ASSERT(twice_area(*rest) > 0);
}

}  // namespace
}  // namespace talus::scatter
