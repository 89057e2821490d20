#include "talus/scatter/sites.h"

#include <initializer_list>
#include <vector>

#include "talus/base/hash.h"
#include "talus/scatter/darts.h"

namespace talus::scatter {
namespace {

using Patch = std::vector<Point>;

enum class PatchKind { corner, edge_along_x, edge_along_y, square };

// In distances. Corner patches are squares of twice kCornerReach, edge patches strips of twice
// kEdgeReach that begin a distance inside the corner patches: what a wider throw leaves free of a
// patch is within a distance of its rim. So strips that share a corner, and squares that share an
// edge, stay more than a distance apart.
constexpr std::int64_t kCornerReach = 4;
constexpr std::int64_t kEdgeReach = 2;
constexpr std::int64_t kWider = 1;

using Patches = RectGrid<Patch>;

// New sites of a patch beside those that are there: thrown in `thrown`, kept in `kept`.
Patch fill_patch(const SiteLattice& lattice, const Rect& thrown, const Rect& kept,
                 std::uint64_t key, std::initializer_list<const Patch*> there) {
  const Rect area = lattice.bounds ? thrown.intersected(*lattice.bounds) : thrown;
  if (area.empty()) return {};
  std::vector<Point> all;
  for (const Patch* patch : there) all.insert(all.end(), patch->begin(), patch->end());
  Patch patch = throw_darts(area, lattice.distance, key, all);
  std::erase_if(patch, [&](const Point& site) { return !kept.contains(site); });
  return patch;
}

std::uint64_t key_of(const SiteLattice& lattice, PatchKind kind, const Point& place) {
  return extend(extend(extend(lattice.key, static_cast<std::int64_t>(kind)), place.x), place.y);
}

Patch corner_patch(const SiteLattice& lattice, const Point& place) {
  const Point corner{place.x * lattice.edge, place.y * lattice.edge};
  const Rect kept = Rect{corner, corner}.expanded(kCornerReach * lattice.distance);
  return fill_patch(lattice, kept.expanded(kWider * lattice.distance), kept,
                    key_of(lattice, PatchKind::corner, place), {});
}

// The strip from the corner at a place to the next.
Patch edge_patch(const SiteLattice& lattice, PatchKind kind, const Patches& corners,
                 const Point& place) {
  const bool along_x = kind == PatchKind::edge_along_x;
  const auto strip = [&](std::int64_t reach) {
    const std::int64_t from = (kCornerReach - 1) * lattice.distance, to = lattice.edge - from;
    const Rect r = along_x ? Rect{{from, -reach}, {to, reach}} : Rect{{-reach, from}, {reach, to}};
    return r.shifted({place.x * lattice.edge, place.y * lattice.edge});
  };
  const Point next = along_x ? Point{place.x + 1, place.y} : Point{place.x, place.y + 1};
  return fill_patch(lattice, strip((kEdgeReach + kWider) * lattice.distance),
                    strip(kEdgeReach * lattice.distance), key_of(lattice, kind, place),
                    {&corners.at(place), &corners.at(next)});
}

// The squares of a range of columns and rows.
Rect area_of(const SiteLattice& lattice, const Rect& squares) {
  const std::int64_t edge = lattice.edge;
  return {{squares.lo.x * edge, squares.lo.y * edge}, {squares.hi.x * edge, squares.hi.y * edge}};
}

}  // namespace

SiteSet make_sites(const SiteLattice& lattice, const Rect& squares, Job* job) {
  using enum PatchKind;
  const auto& [lo, hi] = squares;
  Patches corners({lo, {hi.x + 1, hi.y + 1}}), inner(squares);
  Patches along_x({lo, {hi.x, hi.y + 1}}), along_y({lo, {hi.x + 1, hi.y}});
  const auto fill = [&](Patches& patches, auto&& make) {
    check_cancelled(job);
    patches.parallel_for_each([&](const Point& place, Patch& patch) { patch = make(place); });
  };

  if (lattice.edge >= kLatticeEdgeMin * lattice.distance) {
    fill(corners, [&](const Point& p) { return corner_patch(lattice, p); });
    fill(along_x, [&](const Point& p) { return edge_patch(lattice, edge_along_x, corners, p); });
    fill(along_y, [&](const Point& p) { return edge_patch(lattice, edge_along_y, corners, p); });
  }
  fill(inner, [&](const Point& p) {
    const Point right{p.x + 1, p.y}, above{p.x, p.y + 1}, across{p.x + 1, p.y + 1};
    const Rect area = area_of(lattice, {p, across});
    return fill_patch(lattice, area, area, key_of(lattice, square, p),
                      {&corners.at(p), &corners.at(right), &corners.at(above), &corners.at(across),
                       &along_x.at(p), &along_x.at(above), &along_y.at(p), &along_y.at(right)});
  });

  // Patches reach beyond the range, where they are not all there.
  SiteSet sites(area_of(lattice, squares), lattice.distance);
  for (const Patches* patches : {&corners, &along_x, &along_y, &inner})
    for (const Patch& patch : *patches)
      for (const Point& site : patch)
        if (sites.area().contains(site)) sites.insert(site);
  return sites;
}

}  // namespace talus::scatter
