#include "talus/scatter/darts.h"

#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "talus/base/hash.h"

namespace talus::scatter {
namespace {

// Darts per square that may hold a free point, before the squares are halved.
constexpr double kDartsPerSquare = 0.6;

// Squares of one size whose points may be free; given by their lower corners.
class FreeSquares {
 public:
  FreeSquares(const Rect& area, const SiteSet& sites) : area_(area), sites_(sites) {
    const auto distance = static_cast<std::uint64_t>(sites.distance());
    edge_ =
        static_cast<std::int64_t>(std::bit_floor(std::max<std::uint64_t>(1, distance * 7 / 10)));
    for (std::int64_t y = area.lo.y; y < area.hi.y; y += edge_)
      for (std::int64_t x = area.lo.x; x < area.hi.x; x += edge_) add({x, y});
  }

  std::int64_t edge() const { return edge_; }
  const std::vector<Point>& corners() const { return corners_; }

  void halve() {
    drop_covered();
    edge_ /= 2;
    for (const auto& [x, y] : std::exchange(corners_, {})) {
      add({x, y});
      add({x + edge_, y});
      add({x, y + edge_});
      add({x + edge_, y + edge_});
    }
  }

 private:
  void drop_covered() {
    for (const Point& corner : std::exchange(corners_, {})) add(corner);
  }
  // Keeps a square unless one site's disk covers all of it that lies in the area.
  void add(const Point& corner) {
    const Rect square = Rect{corner, {corner.x + edge_, corner.y + edge_}}.intersected(area_);
    if (square.empty()) return;
    const Point last{square.hi.x - 1, square.hi.y - 1};
    const std::int64_t d = sites_.distance();
    const Rect window{{last.x - d + 1, last.y - d + 1}, {corner.x + d, corner.y + d}};
    const bool covered = sites_.any_near(window, [&](std::size_t i) {
      const Point& s = sites_[i];
      const std::int64_t x = std::max(s.x - corner.x, last.x - s.x);
      const std::int64_t y = std::max(s.y - corner.y, last.y - s.y);
      return x * x + y * y < d * d;
    });
    if (!covered) corners_.push_back(corner);
  }

  const Rect area_;
  const SiteSet& sites_;
  std::int64_t edge_;
  std::vector<Point> corners_;
};

// A value below `bound`, at most 2^32, from the upper bits of a random one.
std::uint64_t below(std::uint64_t random, std::uint64_t bound) {
  return (random >> 32) * bound >> 32;
}

}  // namespace

void throw_darts(const Rect& area, std::uint64_t key, SiteSet& sites) {
  std::int64_t draw = 0;
  FreeSquares squares(area, sites);
  for (; squares.edge() > 1; squares.halve()) {
    const std::vector<Point>& corners = squares.corners();
    const auto darts =
        static_cast<std::size_t>(std::ceil(kDartsPerSquare * static_cast<double>(corners.size())));
    const auto mask = static_cast<std::uint64_t>(squares.edge() - 1);
    for (std::size_t dart = 0; dart < darts; ++dart) {
      const std::uint64_t which = extend(key, draw++), where = extend(key, draw++);
      const Point& corner = corners[below(which, corners.size())];
      const Point p{corner.x + static_cast<std::int64_t>(where & mask),
                    corner.y + static_cast<std::int64_t>((where >> 32) & mask)};
      if (area.contains(p) && !sites.covers(p)) sites.insert(p);
    }
  }
  for (const Point& p : squares.corners())
    if (!sites.covers(p)) sites.insert(p);
}

}  // namespace talus::scatter
