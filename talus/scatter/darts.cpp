#include "talus/scatter/darts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/base/lanes.h"

namespace talus::scatter {
namespace {

// Darts per square that may hold a free point, before the squares are halved.
constexpr double kDartsPerSquare = 1;

// Relative to the lower corner of what is around an area.
struct Spot {
  std::int32_t x;
  std::int32_t y;
};

// Which points of an area are nearer to a site than the distance.
class Disks {
 public:
  Disks(const Rect& area, std::int64_t distance)
      : lo_{area.lo.x - distance, area.lo.y - distance},
        distance_(static_cast<std::int32_t>(distance)),
        columns_per_step_(1 / std::max(1.0, 0.7 * static_cast<double>(distance))) {
    width_ = column(spot(area.hi).x + distance_) + kDoubleLanes;
    const int height = column(spot(area.hi).y + distance_) + 1;
    const auto slots = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height);
    x_.assign(slots, kNowhere);
    y_.assign(slots, kNowhere);
  }

  Spot spot(const Point& p) const {
    return {static_cast<std::int32_t>(p.x - lo_.x), static_cast<std::int32_t>(p.y - lo_.y)};
  }
  Point point(const Spot& s) const { return {lo_.x + s.x, lo_.y + s.y}; }

  // At least the distance from all others.
  void add(const Spot& s) {
    const std::size_t slot = slot_at(column(s.x), column(s.y));
    TALUS_ASSERT(x_[slot] == kNowhere);
    x_[slot] = s.x;
    y_[slot] = s.y;
  }

  // Whether one site is near all points of a box, ends included. Exact: a double holds the squares
  // of all lengths up to the distance.
  bool cover(const Spot& first, const Spot& last) const {
    const std::int32_t reach = distance_ - 1;
    const int x = column(std::max(0, last.x - reach)), top = column(first.y + reach);
    auto covered = Doubles{} > 0;
    for (int y = column(std::max(0, last.y - reach)); y <= top; ++y) {
      // The slots within reach are four at most in a row.
      const auto xs = load<Doubles>(&x_[slot_at(x, y)]), ys = load<Doubles>(&y_[slot_at(x, y)]);
      const Doubles left = xs - first.x, right = last.x - xs, dx = left > right ? left : right;
      const Doubles down = ys - first.y, up = last.y - ys, dy = down > up ? down : up;
      covered |= dx * dx + dy * dy < 1.0 * distance_ * distance_;
    }
    return (covered[0] | covered[1] | covered[2] | covered[3]) != 0;
  }

 private:
  static constexpr double kNowhere = -0x1p40;

  // Slots are so small that two of their points are nearer than the distance.
  int column(std::int32_t steps) const { return static_cast<int>(steps * columns_per_step_); }
  std::size_t slot_at(int x, int y) const { return static_cast<std::size_t>(y * width_ + x); }

  Point lo_;  // of the area and a distance around it
  std::int32_t distance_;
  double columns_per_step_;
  int width_ = 0;
  std::vector<double> x_, y_;  // of the slots' sites
};

// Squares of one size that may hold free points of a box, by their first points.
class FreeSquares {
 public:
  FreeSquares(const Spot& first, const Spot& last, std::int64_t distance, const Disks& disks)
      : last_(last), disks_(disks) {
    const auto widest = static_cast<std::uint32_t>(std::max<std::int64_t>(1, distance * 7 / 10));
    edge_ = static_cast<std::int32_t>(std::bit_floor(widest));
    for (std::int32_t y = first.y; y <= last.y; y += edge_)
      for (std::int32_t x = first.x; x <= last.x; x += edge_) add({x, y});
  }

  std::int32_t edge() const { return edge_; }
  const std::vector<Spot>& squares() const { return squares_; }

  void halve() {
    drop_covered();
    edge_ /= 2;
    for (const auto& [x, y] : std::exchange(squares_, {})) {
      add({x, y});
      add({x + edge_, y});
      add({x, y + edge_});
      add({x + edge_, y + edge_});
    }
  }

 private:
  void drop_covered() {
    for (const Spot& square : std::exchange(squares_, {})) add(square);
  }
  // Keeps a square unless one disk covers all of it that lies in the box.
  void add(const Spot& first) {
    if (first.x > last_.x || first.y > last_.y) return;
    const Spot last{std::min(first.x + edge_ - 1, last_.x), std::min(first.y + edge_ - 1, last_.y)};
    if (!disks_.cover(first, last)) squares_.push_back(first);
  }

  Spot last_;
  const Disks& disks_;
  std::int32_t edge_;
  std::vector<Spot> squares_;
};

// A value below `bound`, at most 2^32, from the upper bits of a random one.
std::uint64_t below(std::uint64_t random, std::uint64_t bound) {
  return (random >> 32) * bound >> 32;
}

}  // namespace

std::vector<Point> throw_darts(const Rect& area, std::int64_t distance, std::uint64_t key,
                               const std::vector<Point>& there) {
  Disks disks(area, distance);
  const Rect around = area.expanded(distance);
  for (const Point& site : there)
    if (around.contains(site)) disks.add(disks.spot(site));

  std::vector<Point> sites;
  const Spot last = disks.spot({area.hi.x - 1, area.hi.y - 1});
  const auto try_at = [&](const Spot& s) {
    if (s.x > last.x || s.y > last.y || disks.cover(s, s)) return;
    disks.add(s);
    sites.push_back(disks.point(s));
  };
  FreeSquares free(disks.spot(area.lo), last, distance, disks);
  for (std::int64_t draw = 0; free.edge() > 1; free.halve()) {
    const std::vector<Spot>& squares = free.squares();
    const double darts = std::ceil(kDartsPerSquare * static_cast<double>(squares.size()));
    const auto mask = static_cast<std::uint64_t>(free.edge() - 1);
    for (double dart = 0; dart < darts; ++dart) {
      const std::uint64_t which = extend(key, draw++), where = extend(key, draw++);
      const Spot& square = squares[below(which, squares.size())];
      try_at({square.x + static_cast<std::int32_t>(where & mask),
              square.y + static_cast<std::int32_t>((where >> 32) & mask)});
    }
  }
  for (const Spot& point : free.squares()) try_at(point);
  return sites;
}

}  // namespace talus::scatter
