#include "talus/field/height_interval.h"

#include <fmt/format.h>

#include <limits>

#include "talus/base/error.h"

namespace talus {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Where a coordinate lies among the middles of cells, in cells.
struct Place {
  int first;  // of two neighbors, or of one twice
  int second;
  double share;  // of the second
};
Place place(double coordinate, int count) {
  const double clamped = std::clamp(coordinate - 0.5, 0.0, count - 1.0);
  const int first = static_cast<int>(clamped);
  return {first, std::min(first + 1, count - 1), clamped - first};
}

double mix(double a, double b, double share) { return share == 0 ? a : a + share * (b - a); }

double height_at(const HeightGrid& grid, const Place& x, const Place& y) {
  const auto row = [&](int at) {
    return mix(double{grid.heights[grid.index(x.first, at)]},
               double{grid.heights[grid.index(x.second, at)]}, x.share);
  };
  return y.share == 0 ? row(y.first) : mix(row(y.first), row(y.second), y.share);
}

}  // namespace

void HeightIntervalSupport::Heights::include(const Heights& other) {
  lower_min = std::min(lower_min, other.lower_min);
  lower_max = std::max(lower_max, other.lower_max);
  upper_min = std::min(upper_min, other.upper_min);
  upper_max = std::max(upper_max, other.upper_max);
}

HeightIntervalSupport::HeightIntervalSupport(const HeightGrid& lower, const HeightGrid& upper,
                                             const Vec2& corner)
    : lower_(lower),
      upper_(upper),
      corner_(corner),
      far_corner_(corner + upper.cell * Vec2(upper.nx, upper.ny)) {
  if (lower.nx != upper.nx || lower.ny != upper.ny || lower.cell != upper.cell)
    throw usage_error(
        fmt::format("the lower surface has {} x {} cells of {:.6g} m and the upper one {} x {} of "
                    "{:.6g} m; give two of the same cells",
                    lower.nx, lower.ny, lower.cell, upper.nx, upper.ny, upper.cell));
  // What is unknown keeps boxes around it from being inside.
  Level level{.nx = upper.nx, .ny = upper.ny};
  for (std::size_t i = 0; i < upper.heights.size(); ++i) {
    const float low = lower.heights[i], high = upper.heights[i];
    const bool is_known = std::isfinite(low) && std::isfinite(high);
    level.squares.push_back(is_known ? Heights{low, low, high, high}
                                     : Heights{kInfinity, kInfinity, -kInfinity, -kInfinity});
  }
  levels_.push_back(std::move(level));
  while (levels_.back().nx > 1 || levels_.back().ny > 1) {
    const Level& fine = levels_.back();
    Level coarse{.nx = (fine.nx + 1) / 2, .ny = (fine.ny + 1) / 2};
    for (int y = 0; y < coarse.ny; ++y)
      for (int x = 0; x < coarse.nx; ++x) {
        Heights all{kInfinity, -kInfinity, kInfinity, -kInfinity};
        for (int v = 2 * y; v < std::min(2 * y + 2, fine.ny); ++v)
          for (int u = 2 * x; u < std::min(2 * x + 2, fine.nx); ++u)
            all.include(
                fine.squares[static_cast<std::size_t>(u) +
                             static_cast<std::size_t>(v) * static_cast<std::size_t>(fine.nx)]);
        coarse.squares.push_back(all);
      }
    levels_.push_back(std::move(coarse));
  }
  const Heights& all = levels_.back().squares.front();
  bool has_room = false;
  for (const Heights& one : levels_.front().squares) has_room |= one.lower_min < one.upper_max;
  if (!has_room)
    throw usage_error("the upper surface is nowhere above the lower one, so that nothing is left");
  bounds_ = {Vec3(corner_, all.lower_min), Vec3(far_corner_, all.upper_max)};
}

// Not a number where the heights are unknown.
HeightIntervalSupport::Interval HeightIntervalSupport::at(const Vec2& p) const {
  const Vec2 cells = (p - corner_) / upper_.cell;
  const Place x = place(cells.x, upper_.nx), y = place(cells.y, upper_.ny);
  return {height_at(lower_, x, y), height_at(upper_, x, y)};
}

bool HeightIntervalSupport::covers(const Vec2& min, const Vec2& max) const {
  return min.x >= corner_.x && min.y >= corner_.y && max.x <= far_corner_.x &&
         max.y <= far_corner_.y;
}

bool HeightIntervalSupport::contains(const Vec3& p) const {
  if (!covers(Vec2(p), Vec2(p))) return false;
  const Interval interval = at(Vec2(p));
  return interval.lower <= p.z && p.z <= interval.upper;
}

// Of all samples that take part in a rectangle of the plan, and maybe more.
HeightIntervalSupport::Heights HeightIntervalSupport::around(const Vec2& min,
                                                             const Vec2& max) const {
  constexpr int kFewSquares = 3;  // along each axis
  const auto sample = [&](double coordinate, int count, int beyond) {
    const double cells = std::clamp(coordinate / upper_.cell - 0.5, 0.0, count - 1.0);
    return std::clamp(static_cast<int>(cells) + beyond, 0, count - 1);
  };
  int x0 = sample(min.x - corner_.x, upper_.nx, 0), x1 = sample(max.x - corner_.x, upper_.nx, 1);
  int y0 = sample(min.y - corner_.y, upper_.ny, 0), y1 = sample(max.y - corner_.y, upper_.ny, 1);
  std::size_t level = 0;
  for (; std::max(x1 - x0, y1 - y0) >= kFewSquares; ++level) {
    x0 /= 2;
    y0 /= 2;
    x1 /= 2;
    y1 /= 2;
  }
  Heights all{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      all.include(levels_[level].squares[static_cast<std::size_t>(x) +
                                         static_cast<std::size_t>(y) *
                                             static_cast<std::size_t>(levels_[level].nx)]);
  return all;
}

BoxState HeightIntervalSupport::compare(const Heights& heights, double bottom, double top) const {
  // Interpolation may round beyond the samples.
  constexpr double kSlack = 1e-12;
  const double slack = kSlack * (std::abs(bottom) + std::abs(top));
  if (top < heights.lower_min - slack || bottom > heights.upper_max + slack)
    return BoxState::outside;
  if (bottom >= heights.lower_max + slack && top <= heights.upper_min - slack)
    return BoxState::inside;
  return BoxState::mixed;
}

BoxState HeightIntervalSupport::classify(const Box3& box) const {
  const Vec2 min = glm::max(Vec2(box.min), corner_), max = glm::min(Vec2(box.max), far_corner_);
  if (min.x > max.x || min.y > max.y) return BoxState::outside;
  const BoxState state = compare(around(min, max), box.min.z, box.max.z);
  const bool reaches_out = !covers(Vec2(box.min), Vec2(box.max));
  return state == BoxState::inside && reaches_out ? BoxState::mixed : state;
}

std::uint64_t HeightIntervalSupport::contains_block(const PointBlock& block) const {
  if (!block.is_upright()) return Support::contains_block(block);
  std::uint64_t bits = 0;
  for (int i = 0; i < kBlockPoints / 4; ++i) {
    const Vec2 p(block.point(i));
    if (!covers(p, p)) continue;
    const Interval interval = at(p);
    for (int z = 0; z < 4; ++z) {
      const double height = block.point(i + 16 * z).z;
      bits |= std::uint64_t{interval.lower <= height && height <= interval.upper} << (i + 16 * z);
    }
  }
  return bits;
}

BlockStates HeightIntervalSupport::classify_block(const PointBlock& centers,
                                                  const Vec3& half) const {
  if (!centers.is_upright()) return Support::classify_block(centers, half);
  BlockStates states;
  for (int i = 0; i < kBlockPoints / 4; ++i) {
    const Vec2 low = Vec2(centers.point(i)) - Vec2(half),
               high = Vec2(centers.point(i)) + Vec2(half);
    const Vec2 min = glm::max(low, corner_), max = glm::min(high, far_corner_);
    const bool is_beside = min.x > max.x || min.y > max.y;
    const Heights heights =
        is_beside ? Heights{kInfinity, kInfinity, -kInfinity, -kInfinity} : around(min, max);
    for (int z = 0; z < 4; ++z) {
      const double height = centers.point(i + 16 * z).z;
      const BoxState state = compare(heights, height - half.z, height + half.z);
      states.outside |= std::uint64_t{state == BoxState::outside} << (i + 16 * z);
      states.inside |= std::uint64_t{state == BoxState::inside && covers(low, high)}
                       << (i + 16 * z);
    }
  }
  return states;
}

}  // namespace talus
