// The sites of one size class anywhere on the plane.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/job.h"
#include "talus/scatter/site_set.h"

namespace talus::scatter {

// A lattice of squares, at least `kLatticeEdgeMin` distances wide unless one square holds all of
// `bounds`. Sites and cells are functions of it and of their square's column and row alone.
struct SiteLattice {
  std::int64_t edge = 0;
  std::int64_t distance = 0;  // between sites, at least
  std::uint64_t key = 0;
  std::optional<Rect> bounds;  // none beyond
};

constexpr std::int64_t kLatticeEdgeMin = 16;

// Sites of the squares from `squares.lo` up to, but without, `squares.hi`, in columns and rows: a
// maximal Poisson-disk set of the whole plane. A site in any range of squares is one in every range
// that holds its square.
//
// As corners, edges and squares of Wang tiles: first darts are thrown around each corner of the
// lattice, then along each edge between what its two corners hold, then in the squares. Corners and
// edges are cut out of a wider throw, so that their rims do not show, and edges and squares are far
// enough apart never to meet: a square depends on its own corners and edges only.
SiteSet make_sites(const SiteLattice& lattice, const Rect& squares, Job* job = nullptr);

}  // namespace talus::scatter
