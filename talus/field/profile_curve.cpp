#include "talus/field/profile_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "talus/base/error.h"
#include "talus/field/catmull_rom.h"

namespace talus {
namespace {

constexpr double kFarthest = 1e6;
constexpr std::size_t kMostPoints = 256;
constexpr double kNearest = 1e-6;  // points in a row, of the largest coordinate
constexpr std::size_t kSamplesPerSpan = 16;
constexpr double kThinnest = 1e-6;  // area, of the reach squared
constexpr std::size_t kPointsPerSpan = 12;
constexpr std::size_t kFinePerPoint = 4;
constexpr double kPointsMax = 1e6;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

void check_points(const std::vector<Vec2>& points) {
  if (points.size() < 3)
    throw usage_error(
        fmt::format("a profile of {} points encloses nothing; give at least 3", points.size()));
  if (points.size() > kMostPoints)
    throw usage_error(fmt::format("a profile of {} points is too fine; give at most {}",
                                  points.size(), kMostPoints));
  double largest = 0;
  for (const Vec2& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &p = points[i], &next = points[(i + 1) % points.size()];
    if (!(std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest))
      throw usage_error(fmt::format("a profile's point ({}, {}) is too far away; it may be {} m",
                                    p.x, p.y, kFarthest));
    if (glm::length(next - p) <= kNearest * largest)
      throw usage_error(
          fmt::format("a profile has the point ({}, {}) twice in a row; leave one out", p.x, p.y));
  }
}

// Whether each of two segments ends on both sides of the other.
bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto split = [](const Vec2& from, const Vec2& to, const Vec2& p, const Vec2& q) {
    return (cross(to - from, p - from) > 0) != (cross(to - from, q - from) > 0);
  };
  return split(a, b, c, d) && split(c, d, a, b);
}

void check_crossings(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n - (i == 0); ++j)
      if (cross_each_other(outline[i], outline[i + 1], outline[j], outline[(j + 1) % n]))
        throw usage_error(fmt::format(
            "a profile crosses itself near ({:.4g}, {:.4g}), between its points {} and {}; give "
            "its points in order around it",
            outline[i].x, outline[i].y, i / kSamplesPerSpan, j / kSamplesPerSpan));
}

double area_of(const std::vector<Vec2>& outline) {
  double twice = cross(outline.back(), outline.front());
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) twice += cross(outline[i], outline[i + 1]);
  return 0.5 * twice;
}

// Shares evenly spaced by the longest way that any of the curves makes meanwhile, measured in so
// many equal parts.
std::vector<double> shares_along(std::span<const ProfileCurve> curves, std::size_t parts,
                                 double spacing) {
  const auto share = [parts](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(parts);
  };
  std::vector<double> way{0};
  for (std::size_t i = 0; i < parts; ++i) {
    double longest = 0;
    for (const ProfileCurve& curve : curves)
      longest = std::max(longest, glm::length(curve.at(share(i + 1)) - curve.at(share(i))));
    way.push_back(way.back() + longest);
  }
  const double count =
      std::max(std::ceil(way.back() / spacing), static_cast<double>(parts / kFinePerPoint));
  if (count > kPointsMax)
    throw usage_error(fmt::format(
        "a profile {:.4g} m around has more than a million points {:.3g} m apart; choose a "
        "smaller profile or coarser roughness",
        way.back(), spacing));
  std::vector<double> shares;
  std::size_t i = 0;
  for (double k = 0; k < count; ++k) {
    const double place = k / count * way.back();
    while (way[i + 1] <= place) ++i;
    shares.push_back(std::lerp(share(i), share(i + 1), (place - way[i]) / (way[i + 1] - way[i])));
  }
  return shares;
}

}  // namespace

ProfileCurve::ProfileCurve(std::vector<Vec2> points) : points_(std::move(points)) {
  check_points(points_);
  std::vector<Vec2> outline(points_.size() * kSamplesPerSpan);
  for (std::size_t i = 0; i < outline.size(); ++i)
    outline[i] = at(static_cast<double>(i) / static_cast<double>(outline.size()));
  check_crossings(outline);
  for (const Vec2& p : outline) reach_ = std::max(reach_, glm::length(p));
  const double area = area_of(outline);
  if (!(std::abs(area) >= kThinnest * reach_ * reach_))
    throw usage_error("a profile's points lie on one line and enclose nothing; move one of them");
  if (area < 0) std::reverse(points_.begin() + 1, points_.end());
}

Vec2 ProfileCurve::at(double t) const {
  const std::size_t n = points_.size();
  const double place = t * static_cast<double>(n), span = std::floor(place);
  const std::size_t i = static_cast<std::size_t>(span) % n;
  return catmull_rom(points_[(i + n - 1) % n], points_[i], points_[(i + 1) % n],
                     points_[(i + 2) % n], place - span);
}

std::vector<std::vector<Vec2>> sample_alike(std::span<const ProfileCurve> curves, double spacing) {
  std::size_t spans = 0;
  for (const ProfileCurve& curve : curves) spans = std::max(spans, curve.spans());
  const auto shares = shares_along(curves, kFinePerPoint * kPointsPerSpan * spans, spacing);
  std::vector<std::vector<Vec2>> outlines;
  for (const ProfileCurve& curve : curves) {
    std::vector<Vec2>& outline = outlines.emplace_back();
    for (const double t : shares) outline.push_back(curve.at(t));
  }
  return outlines;
}

}  // namespace talus
