#include "talus/tools/surface_profiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "talus/base/parallel.h"

namespace talus {
namespace {

// How much of the materials lies in a column between a height and each of increasing ones above it,
// in metres.
void filled_from(std::span<const Layer> column, const TerrainGrid& grid,
                 const MaterialSet& materials, double from, std::span<const double> heights,
                 std::span<double> filled) {
  double sum = 0, bottom = from;
  std::size_t next = 0;
  const auto pass = [&](double top, Material material) {
    const double share = materials.contains(material) ? 1 : 0;
    for (; next < heights.size() && heights[next] <= top; ++next)
      filled[next] = sum + share * (heights[next] - bottom);
    if (top <= bottom) return;
    sum += share * (top - bottom);
    bottom = top;
  };
  pass(grid.floor * grid.step, Material::bedrock);
  for (const Layer& layer : column) pass(layer.top() * grid.step, layer.material());
  pass(heights.back(), Material::air);
}

// Pairs of a crossing and a boundary, or of two crossings.
using Pairs = std::vector<std::optional<std::size_t>>;  // for each of the first its partner

constexpr int kHalvings = 24;  // from a level to the next: to a millionth

// Partners are of one kind, at most `farthest` apart and in the same order; nearest first.
template <class First, class Second>
Pairs pair_up(const std::vector<First>& first, const std::vector<Second>& second, double farthest) {
  struct Candidate {
    double distance;
    std::size_t i, j;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j)
      if (const double d = std::abs(first[i].z - second[j].z);
          first[i].top == second[j].top && d <= farthest)
        candidates.push_back({d, i, j});
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.i, a.j) < std::tie(b.distance, b.i, b.j);
  });
  Pairs pairs(first.size());
  for (const Candidate& c : candidates) {
    bool fits = true;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (pairs[i]) fits = fits && (i < c.i ? *pairs[i] < c.j : i > c.i && *pairs[i] > c.j);
    if (fits) pairs[c.i] = c.j;
  }
  return pairs;
}

struct Interval {
  Steps bottom, top;
};

// Of bedrock, upward; the first begins below everything.
std::vector<Interval> bedrock_of(const ColumnEditor& column) {
  std::vector<Interval> intervals{{-kStepsMax, column.floor()}};
  Steps bottom = column.floor();
  for (const Layer& layer : column.layers()) {
    if (layer.material() == Material::bedrock) {
      if (intervals.back().top == bottom)
        intervals.back().top = layer.top();
      else
        intervals.push_back({bottom, layer.top()});
    }
    bottom = layer.top();
  }
  return intervals;
}

// Bedrock between boundaries in order of height; one that repeats what is already so has no say.
std::vector<Interval> between(std::vector<Crossing> boundaries, double step) {
  std::stable_sort(boundaries.begin(), boundaries.end(),
                   [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
  std::vector<Interval> intervals;
  std::optional<Steps> bottom = -kStepsMax;
  for (const Crossing& boundary : boundaries) {
    const auto z = static_cast<Steps>(std::lround(boundary.z / step));
    if (boundary.top && bottom) {
      intervals.push_back({*bottom, z});
      bottom.reset();
    } else if (!boundary.top && !bottom) {
      bottom = z;
    }
  }
  return intervals;
}

// Calls `use(bottom, top)` for what is in the first intervals and not in the second.
void for_each_difference(const std::vector<Interval>& first, const std::vector<Interval>& second,
                         auto&& use) {
  for (const Interval& interval : first) {
    Steps bottom = interval.bottom;
    for (const Interval& other : second) {
      if (other.top <= bottom || other.bottom >= interval.top) continue;
      if (other.bottom > bottom) use(bottom, other.bottom);
      bottom = std::max(bottom, other.top);
    }
    if (bottom < interval.top) use(bottom, interval.top);
  }
}

}  // namespace

SurfaceProfiles::SurfaceProfiles(const LayeredTerrain& terrain, const MaterialSet& materials,
                                 double sigma, const Vec3& center, double radius)
    : grid_(terrain.grid()),
      center_(center),
      radius_(radius),
      lowest_(center.z - radius),
      spacing_(2 * radius / (kLevels - 1)),
      area_(grid_.columns_within(Vec2(center) - radius, Vec2(center) + radius)) {
  add_up(terrain, materials, sigma);
}

// The cube's part of each column first, then sums of those along rows, and of rows, each from the
// one before.
void SurfaceProfiles::add_up(const LayeredTerrain& terrain, const MaterialSet& materials,
                             double sigma) {
  using Levels = std::array<double, kLevels>;
  const int half = static_cast<int>(sigma / grid_.cell);
  const int width = area_.x_end - area_.x_begin, height = area_.y_end - area_.y_begin;
  if (width <= 0 || height <= 0) return;
  Levels lower, upper;
  for (std::size_t k = 0; k < kLevels; ++k) {
    const double z = level(static_cast<int>(k));
    lower[k] = z - sigma;
    upper[k] = z + sigma;
  }

  const auto row_count = static_cast<std::size_t>(height + 2 * half);
  std::vector<std::vector<Levels>> rows(row_count);
  parallel_for(row_count, [&](std::size_t r) {
    const int y = std::clamp(area_.y_begin - half + static_cast<int>(r), 0, grid_.ny - 1);
    std::vector<Levels> columns(static_cast<std::size_t>(width + 2 * half));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const int x = std::clamp(area_.x_begin - half + static_cast<int>(i), 0, grid_.nx - 1);
      Levels below;
      filled_from(terrain.column(x, y), grid_, materials, lower[0], upper, columns[i]);
      filled_from(terrain.column(x, y), grid_, materials, lower[0], lower, below);
      for (std::size_t k = 0; k < kLevels; ++k) columns[i][k] -= below[k];
    }
    Levels sum{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::size_t out = static_cast<std::size_t>(2 * half) + 1;  // columns in a sum
      for (std::size_t k = 0; k < kLevels; ++k) {
        sum[k] += columns[i][k];
        if (i >= out) sum[k] -= columns[i - out][k];
      }
      if (i + 1 >= out) rows[r].push_back(sum);
    }
  });

  const double whole = (2 * half + 1) * (2 * half + 1) * 2 * sigma;
  const auto columns = static_cast<std::size_t>(width);
  values_.resize(columns * static_cast<std::size_t>(height) * kLevels);
  parallel_for(columns, [&](std::size_t x) {
    Levels sum{};
    const std::size_t out = static_cast<std::size_t>(2 * half) + 1;
    for (std::size_t r = 0; r < row_count; ++r) {
      for (std::size_t k = 0; k < kLevels; ++k) {
        sum[k] += rows[r][x][k];
        if (r >= out) sum[k] -= rows[r - out][x][k];
      }
      if (r + 1 < out) continue;
      double* const values = &values_[((r + 1 - out) * columns + x) * kLevels];
      for (std::size_t k = 0; k < kLevels; ++k) values[k] = 2 * sum[k] / whole - 1;
    }
  });
}

SurfaceMove SurfaceProfiles::move(int x, int y, const std::function<double(double)>& added) const {
  const Vec2 off = grid_.center(x, y) - Vec2(center_);
  const double squared = radius_ * radius_ - off.x * off.x - off.y * off.y;
  SurfaceMove result;
  if (squared <= 0) return result;
  result.low = center_.z - std::sqrt(squared);
  result.high = center_.z + std::sqrt(squared);

  const auto column = static_cast<std::size_t>(y - area_.y_begin) *
                          static_cast<std::size_t>(area_.x_end - area_.x_begin) +
                      static_cast<std::size_t>(x - area_.x_begin);
  const double* const values = &values_[column * kLevels];
  double added_below = added(level(0));
  for (int k = 0; k + 1 < kLevels; ++k) {
    const double below = values[k], above = values[k + 1];
    const double added_above = added(level(k + 1));
    const auto linear = [&](double share) { return below + share * (above - below); };
    if ((below > 0) != (above > 0))
      result.before.push_back({level(k) + spacing_ * (below / (below - above)), below > 0});
    const bool in = below + added_below > 0, out = above + added_above > 0;
    if (in != out && added_below == 0 && added_above == 0) {
      result.after.push_back({level(k) + spacing_ * (below / (below - above)), in});
    } else if (in != out) {
      double low = 0, high = 1;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        const bool inside = linear(middle) + added(level(k) + middle * spacing_) > 0;
        (inside == in ? low : high) = middle;
      }
      result.after.push_back({level(k) + 0.5 * (low + high) * spacing_, in});
    }
    added_below = added_above;
  }
  return result;
}

void move_boundaries(ColumnEditor& column, const SurfaceMove& move, double step, bool carve) {
  if (move.high <= move.low) return;
  const std::vector<Interval> old = bedrock_of(column);
  std::vector<Crossing> boundaries;
  for (const Interval& interval : old) {
    if (interval.bottom > -kStepsMax) boundaries.push_back({interval.bottom * step, false});
    boundaries.push_back({interval.top * step, true});
  }

  const double farthest = move.high - move.low;
  const Pairs moved_to = pair_up(move.before, move.after, farthest);
  const Pairs crossing_of = pair_up(boundaries, move.before, farthest);
  std::vector<Crossing> changed;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (!crossing_of[i]) {
      changed.push_back(boundaries[i]);
    } else if (const auto& to = moved_to[*crossing_of[i]]) {
      const double by = move.after[*to].z - move.before[*crossing_of[i]].z;
      changed.push_back({boundaries[i].z + by, boundaries[i].top});
    }
  }
  for (std::size_t j = 0; j < move.after.size(); ++j)
    if (std::find(moved_to.begin(), moved_to.end(), j) == moved_to.end())
      changed.push_back(move.after[j]);

  // The steps whose centers are in the ball.
  const auto low = static_cast<Steps>(std::ceil(move.low / step - 0.5));
  const auto high = static_cast<Steps>(std::floor(move.high / step + 0.5));
  const std::vector<Interval> made = between(std::move(changed), step);
  const auto replace = [&](Steps bottom, Steps top) {
    column.replace(std::max(bottom, low), std::min(top, high),
                   carve ? Material::air : Material::bedrock);
  };
  if (carve)
    for_each_difference(old, made, replace);
  else
    for_each_difference(made, old, replace);
}

}  // namespace talus
