#include "talus/scatter/grading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "talus/base/elementary.h"
#include "talus/base/error.h"

namespace talus {
namespace {

double power(double x, double exponent) { return exponential(exponent * logarithm(x)); }

// By what power of its size a stone counts.
double dimension(GradingMeasure measure) {
  switch (measure) {
    case GradingMeasure::mass:
      return 3;
    case GradingMeasure::area:
      return 2;
    case GradingMeasure::number:
      return 0;
  }
  return 0;
}

// The fraction of the measure that is finer than a size, among the sizes from the least to the
// most.
class FinerFraction {
 public:
  explicit FinerFraction(const GradingParams& params) : params_(params) {
    const auto& points = params.points;
    sizes_ = params.law == GradingLaw::curve ? Range{points.front().size, points.back().size}
                                             : params.sizes;
    below_ = total(sizes_.min);
    all_ = total(sizes_.max) - below_;
  }

  const Range& sizes() const { return sizes_; }
  double operator()(double size) const {
    return (total(std::clamp(size, sizes_.min, sizes_.max)) - below_) / all_;
  }

 private:
  // Up to a factor and a constant.
  double total(double size) const {
    switch (params_.law) {
      case GradingLaw::curve:
        return on_curve(size);
      case GradingLaw::rosin_rammler:
        return 1 - exponential(-power(size / params_.scale, params_.exponent));
      case GradingLaw::power_law: {
        // The measure's density over size is size^(d - 1 - exponent).
        const double d = dimension(params_.measure) - params_.exponent;
        const double x = logarithm(size / params_.sizes.min);
        return std::abs(d) < 1e-9 ? x : exponential(d * x) / d;
      }
    }
    return 0;
  }

  double on_curve(double size) const {
    const auto& points = params_.points;
    const auto next = std::find_if(points.begin() + 1, points.end() - 1,
                                   [&](const GradingPoint& point) { return point.size >= size; });
    const GradingPoint &a = next[-1], &b = *next;
    const double t = logarithm(size / a.size) / logarithm(b.size / a.size);
    return a.passing + t * (b.passing - a.passing);
  }

  const GradingParams& params_;
  Range sizes_;
  double below_ = 0;
  double all_ = 1;
};

void validate_grading(const GradingParams& params, const std::string& path) {
  validate(params, path);
  if (params.law != GradingLaw::curve) {
    if (params.sizes.min >= params.sizes.max)
      throw usage_error(fmt::format("{}.sizes = [{}, {}] m: the largest must exceed the smallest",
                                    path, params.sizes.min, params.sizes.max));
    return;
  }
  const auto& points = params.points;
  if (points.size() < 2)
    throw usage_error(fmt::format("{}.points: a curve needs two points at least", path));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [size, passing] = points[i];
    const bool grows = i == 0 || (size > points[i - 1].size && passing >= points[i - 1].passing);
    if (!(size > 0 && passing >= 0 && passing <= 1 && grows))
      throw usage_error(fmt::format(
          "{}.points[{}] = [{}, {}]: sizes must be positive and increase, and the finer fractions "
          "not decrease from 0 to 1",
          path, i, size, passing));
  }
  if (points.front().passing == points.back().passing)
    throw usage_error(
        fmt::format("{}.points: all finer fractions are {}", path, points[0].passing));
}

}  // namespace

std::vector<SizeClass> classes_of_grading(const GradingParams& params, const std::string& path) {
  validate_grading(params, path);
  const FinerFraction finer(params);
  const auto& [least, most] = finer.sizes();
  const double step = logarithm(most / least) / params.steps;
  std::vector<SizeClass> classes;
  double sum = 0;
  for (int i = params.steps - 1; i >= 0; --i) {
    const double low = least * exponential(i * step), high = least * exponential((i + 1) * step);
    const double size = std::sqrt(low * high);
    const double area =
        (finer(high) - finer(low)) * power(size / most, 2 - dimension(params.measure));
    if (area <= 0) continue;
    classes.push_back({.radius = size / kSizePerRadius, .area_share = area});
    sum += area;
  }
  for (SizeClass& size : classes) size.area_share *= params.coverage / sum;
  return classes;
}

std::vector<double> plot_sizes(const Plots& plots) {
  std::vector<double> sizes;
  for (const Plot& plot : plots.plots) {
    const auto corners = plots.corners_of(plot);
    double twice_area = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Vec2 a = corners[i - 1] - corners[0], b = corners[i] - corners[0];
      twice_area += a.x * b.y - a.y * b.x;
    }
    sizes.push_back(std::sqrt(2 * twice_area / std::numbers::pi));
  }
  return sizes;
}

double grading_error(const GradingParams& params, std::vector<double> sizes) {
  const FinerFraction finer(params);
  std::sort(sizes.begin(), sizes.end());
  const auto weight = [&](double size) { return power(size, dimension(params.measure)); };
  double all = 0, below = 0, error = sizes.empty() ? 1 : 0;
  for (const double size : sizes) all += weight(size);
  for (const double size : sizes) {
    const double fraction = finer(size), above = below + weight(size) / all;
    error = std::max({error, std::abs(fraction - below), std::abs(fraction - above)});
    below = above;
  }
  return error;
}

}  // namespace talus
