// Points of the plane with whole coordinates, none near another, found by place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "talus/base/error.h"
#include "talus/scatter/plane.h"

namespace talus::scatter {

// Sites in the order they came in. Their distances are at least `distance`, so that each has a
// square of a grid for itself.
class SiteSet {
 public:
  SiteSet(const Rect& area, std::int64_t distance)
      : area_(area), distance_(distance), columns_per_step_(1 / square_edge(distance)) {
    width_ = column(area.hi.x - area.lo.x) + 1;
    const std::int64_t height = column(area.hi.y - area.lo.y) + 1;
    slots_.assign(static_cast<std::size_t>(width_ * height), kEmpty);
  }

  const Rect& area() const { return area_; }
  std::int64_t distance() const { return distance_; }
  std::size_t size() const { return sites_.size(); }
  const Point& operator[](std::size_t i) const { return sites_[i]; }

  // The site must lie in the area, and no other nearer than the distance.
  void insert(const Point& site) {
    std::int32_t& slot = slots_[slot_of(site)];
    TALUS_ASSERT(area_.contains(site) && slot == kEmpty);
    slot = static_cast<std::int32_t>(sites_.size());
    sites_.push_back(site);
  }

  // Whether `pred(index)` holds for a site in the window, or within a square of the grid of it.
  template <class Predicate>
  bool any_near(const Rect& window, Predicate&& pred) const {
    const Rect w = window.intersected(area_);
    if (w.empty()) return false;
    const std::int64_t x0 = column(w.lo.x - area_.lo.x), x1 = column(w.hi.x - 1 - area_.lo.x);
    const std::int64_t y0 = column(w.lo.y - area_.lo.y), y1 = column(w.hi.y - 1 - area_.lo.y);
    for (std::int64_t y = y0; y <= y1; ++y) {
      const std::int32_t* row = slots_.data() + y * width_;
      for (std::int64_t x = x0; x <= x1; ++x)
        if (row[x] != kEmpty && pred(static_cast<std::size_t>(row[x]))) return true;
    }
    return false;
  }

 private:
  static constexpr std::int32_t kEmpty = -1;

  // Two points of a square are nearer than the distance.
  static double square_edge(std::int64_t distance) {
    return std::max(1.0, 0.7 * static_cast<double>(distance));
  }
  std::int64_t column(std::int64_t steps) const {
    return static_cast<std::int64_t>(static_cast<double>(steps) * columns_per_step_);
  }
  std::size_t slot_of(const Point& p) const {
    return static_cast<std::size_t>(column(p.y - area_.lo.y) * width_ + column(p.x - area_.lo.x));
  }

  Rect area_;
  std::int64_t distance_;
  double columns_per_step_;  // of the grid
  std::int64_t width_ = 0;
  std::vector<std::int32_t> slots_;
  std::vector<Point> sites_;
};

}  // namespace talus::scatter
