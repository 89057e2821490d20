#include "talus/scatter/sites.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <tuple>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/scatter/darts.h"

namespace talus::scatter {
namespace {

bool by_place(const Point& a, const Point& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

std::vector<Point> sorted_sites(const SiteSet& sites, const Rect& area) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (area.contains(sites[i])) result.push_back(sites[i]);
  std::sort(result.begin(), result.end(), by_place);
  return result;
}

// Two sites nearer than the distance; compares each with those up to the distance above it.
bool any_too_near(const SiteSet& sites) {
  const std::vector<Point> sorted = sorted_sites(sites, sites.area());
  const std::int64_t d = sites.distance();
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].y - sorted[i].y < d; ++j)
      if (squared_distance(sorted[i], sorted[j]) < d * d) return true;
  return false;
}

SiteSet set_of(const Rect& area, std::int64_t distance, const std::vector<Point>& sites) {
  SiteSet set(area, distance);
  for (const Point& site : sites) set.insert(site);
  return set;
}

bool covers(const SiteSet& sites, const Point& p) {
  const std::int64_t d = sites.distance();
  return sites.any_near(Rect{p, {p.x + 1, p.y + 1}}.expanded(d),
                        [&](std::size_t i) { return squared_distance(sites[i], p) < d * d; });
}

RC_GTEST_PROP(Darts, LeaveNoPointFreeAndNoSitesNear, ()) {
  // Small enough to look at every point.
  const Point lo{*rc::gen::inRange(-200, 200), *rc::gen::inRange(-200, 200)};
  const Rect area{lo, {lo.x + *rc::gen::inRange(1, 150), lo.y + *rc::gen::inRange(1, 150)}};
  const std::int64_t d = *rc::gen::inRange(1, 40);
  std::vector<Point> all{{lo.x + *rc::gen::inRange(-30, 30), lo.y}};
  for (const Point& site : throw_darts(area, d, *rc::gen::arbitrary<std::uint64_t>(), all)) {
    RC_ASSERT(area.contains(site));
    all.push_back(site);
  }
  const SiteSet sites = set_of(area.expanded(40), d, all);
  RC_ASSERT(!any_too_near(sites));
  for (std::int64_t y = area.lo.y; y < area.hi.y; ++y)
    for (std::int64_t x = area.lo.x; x < area.hi.x; ++x) RC_ASSERT(covers(sites, {x, y}));
}

TEST(Darts, FillAsRandomSequentialAdditionDoes) {
  // Away from the rim, disks of half the distance jam at 0.547 of the plane.
  const std::int64_t d = 1000, edge = 200 * d;
  const Rect area{{0, 0}, {edge, edge}};
  const SiteSet sites = set_of(area, d, throw_darts(area, d, 1));
  const std::size_t inner = sorted_sites(sites, area.expanded(-5 * d)).size();
  EXPECT_NEAR(static_cast<double>(inner) * 0.785398 / (190 * 190), 0.547, 0.003);
}

SiteLattice lattice_of(std::uint64_t key, std::int64_t distance, std::int64_t edge) {
  return {.edge = edge, .distance = distance, .key = key};
}

RC_GTEST_PROP(Sites, KeepTheirDistanceAndLeaveNoPlaceAcrossSquares, ()) {
  const std::int64_t d = *rc::gen::inRange(50, 100'000);
  const SiteLattice lattice =
      lattice_of(*rc::gen::arbitrary<std::uint64_t>(), d, d * *rc::gen::inRange(16, 24));
  const std::int64_t x = *rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'000);
  const std::int64_t y = *rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'000);
  const SiteSet sites = make_sites(lattice, {{x, y}, {x + 3, y + 2}});
  RC_ASSERT(!any_too_near(sites));

  // Probes farther than the distance from the rim, where sites beyond may count.
  const Rect probed = sites.area().expanded(-d);
  for (std::int64_t i = 0; i < 5'000; ++i) {
    const std::uint64_t h = hash(lattice.key, Purpose::scatter_sites, i);
    const Point p{
        probed.lo.x + static_cast<std::int64_t>(
                          (h >> 32) % static_cast<std::uint64_t>(probed.hi.x - probed.lo.x)),
        probed.lo.y + static_cast<std::int64_t>((h & 0xffffffff) % static_cast<std::uint64_t>(
                                                                       probed.hi.y - probed.lo.y))};
    RC_ASSERT(covers(sites, p));
  }
}

RC_GTEST_PROP(Sites, AreThoseOfTheirSquareInWhateverRange, ()) {
  const std::int64_t d = *rc::gen::inRange(50, 1000), edge = 16 * d;
  const SiteLattice lattice = lattice_of(*rc::gen::arbitrary<std::uint64_t>(), d, edge);
  const Point lo{*rc::gen::inRange(-5, 5), *rc::gen::inRange(-5, 5)};
  const SiteSet all = make_sites(lattice, {lo, {lo.x + 3, lo.y + 3}});
  const SiteSet one = make_sites(lattice, {{lo.x + 1, lo.y + 2}, {lo.x + 2, lo.y + 3}});
  RC_ASSERT(sorted_sites(one, one.area()) == sorted_sites(all, one.area()));
}

TEST(Sites, CrowdAtTheLatticeTheyAreMadeInByLessThanAnEighth) {
  // Their numbers by how far they are from a line of the lattice.
  const std::int64_t d = 1000, edge = 32 * d;
  const SiteSet sites = make_sites(lattice_of(7, d, edge), {{0, 0}, {12, 12}});
  std::vector<double> counts(32);
  for (std::size_t i = 0; i < sites.size(); ++i)
    counts[static_cast<std::size_t>(sites[i].x % edge / d)] += 1;
  const double mean = static_cast<double>(sites.size()) / 32;
  for (const double count : counts) EXPECT_NEAR(count / mean, 1, 0.125);
}

TEST(Sites, AreTheSameForOneAndTwoThreads) {
  const SiteLattice lattice = lattice_of(3, 1000, 20'000);
  const Rect squares{{-2, -2}, {3, 3}};
  const auto made = [&](int threads) {
    const ThreadLimit limit(threads);
    const SiteSet sites = make_sites(lattice, squares);
    std::vector<Point> result;
    for (std::size_t i = 0; i < sites.size(); ++i) result.push_back(sites[i]);
    return result;
  };
  EXPECT_EQ(made(1), made(2));
}

}  // namespace
}  // namespace talus::scatter
