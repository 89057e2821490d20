// The plane in whole steps of a pattern's own grid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "talus/base/parallel.h"

namespace talus::scatter {

struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;

  bool operator==(const Point&) const = default;
};

inline std::int64_t squared_distance(const Point& a, const Point& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Columns from the left, each from below.
inline bool by_place(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Points from `lo` up to, but without, `hi`.
struct Rect {
  Point lo;
  Point hi;

  bool empty() const { return lo.x >= hi.x || lo.y >= hi.y; }
  bool contains(const Point& p) const {
    return p.x >= lo.x && p.y >= lo.y && p.x < hi.x && p.y < hi.y;
  }
  Rect expanded(std::int64_t margin) const {
    return {{lo.x - margin, lo.y - margin}, {hi.x + margin, hi.y + margin}};
  }
  Rect intersected(const Rect& r) const {
    return {{std::max(lo.x, r.lo.x), std::max(lo.y, r.lo.y)},
            {std::min(hi.x, r.hi.x), std::min(hi.y, r.hi.y)}};
  }
  Rect shifted(const Point& by) const {
    return {{lo.x + by.x, lo.y + by.y}, {hi.x + by.x, hi.y + by.y}};
  }
  bool operator==(const Rect&) const = default;
};

// One value for each point of a rectangle, in rows.
template <class T>
class RectGrid {
 public:
  explicit RectGrid(const Rect& points) : points_(points), width_(points.hi.x - points.lo.x) {
    values_.resize(static_cast<std::size_t>(width_ * (points.hi.y - points.lo.y)));
  }

  const Rect& points() const { return points_; }
  T& at(const Point& p) { return values_[index(p)]; }
  const T& at(const Point& p) const { return values_[index(p)]; }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  // Calls `body(point, value)` for each point, row by row.
  template <class Body>
  void for_each(Body&& body) {
    for (std::size_t i = 0; i < values_.size(); ++i) body(point(i), values_[i]);
  }
  template <class Body>
  void for_each(Body&& body) const {
    for (std::size_t i = 0; i < values_.size(); ++i) body(point(i), values_[i]);
  }
  // The same in parallel.
  template <class Body>
  void parallel_for_each(Body&& body) {
    parallel_for(values_.size(), [&](std::size_t i) { body(point(i), values_[i]); });
  }

 private:
  std::size_t index(const Point& p) const {
    return static_cast<std::size_t>((p.y - points_.lo.y) * width_ + p.x - points_.lo.x);
  }

  Point point(std::size_t i) const {
    const auto index = static_cast<std::int64_t>(i);
    return {points_.lo.x + index % width_, points_.lo.y + index / width_};
  }

  Rect points_;
  std::int64_t width_;
  std::vector<T> values_;
};

}  // namespace talus::scatter
