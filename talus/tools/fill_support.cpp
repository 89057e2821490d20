#include "talus/tools/fill_support.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "talus/field/gradient_noise.h"

namespace talus {
namespace {

constexpr int kRoughnessOctaves = 4;

// Along a column places are asked so close together: in cells, and in sizes of the finest bumps.
constexpr double kShortestCells = 0.125;
constexpr double kShortestBumps = 0.25;

// The finest noise is so much finer than the roughness's size.
const double kFinestShare = std::pow(1 / FractalParams{}.lacunarity, kRoughnessOctaves - 1);

// A support whose surface is moved by noise.
class RoughSupport final : public Support {
 public:
  RoughSupport(const Support& support, double roughness, double size, std::uint64_t seed)
      : support_(support), noise_(seed), roughness_(roughness), size_(size) {}

  bool contains(const Vec3& p) const override {
    // Most places are too far from the surface for the noise to matter.
    if (support_.clearance(p) > roughness_) return support_.contains(p);
    const Vec3 noise = fractal(noise_, p / size_, kFractal);
    return support_.contains(p + roughness_ / std::max(1.0, glm::length(noise)) * noise);
  }
  BoxState classify(const Box3& box) const override {
    const Vec3 center = box.center();
    if (support_.clearance(center) > roughness_ + 0.5 * glm::length(box.size()))
      return support_.contains(center) ? BoxState::inside : BoxState::outside;
    return support_.classify(box.expanded(roughness_));
  }
  double clearance(const Vec3& p) const override {
    return std::max(0.0, support_.clearance(p) - roughness_);
  }
  Box3 bounds() const override { return support_.bounds().expanded(roughness_); }

 private:
  static constexpr FractalParams kFractal{.octaves = kRoughnessOctaves};
  const Support& support_;
  GradientNoise noise_;
  double roughness_;
  double size_;
};

struct Run {
  Steps bottom = 0;
  Steps top = 0;
};

// The steps of one column whose centers a support holds.
class ColumnRuns {
 public:
  ColumnRuns(const Support& support, Vec2 place, double step, Steps shortest)
      : support_(support), place_(place), step_(step), shortest_(shortest) {}

  const std::vector<Run>& find(Steps bottom, Steps top) {
    runs_.clear();
    if (bottom < top) visit(bottom, top);
    return runs_;
  }

 private:
  Vec3 center(Steps z) const { return {place_, (z + 0.5) * step_}; }

  void visit(Steps bottom, Steps top) {
    const BoxState state = support_.classify({center(bottom), center(top - 1)});
    if (state == BoxState::outside) return;
    if (state == BoxState::inside) return add(bottom, top);
    if (top - bottom > shortest_) {
      const Steps middle = bottom + (top - bottom) / 2;
      visit(bottom, middle);
      visit(middle, top);
      return;
    }
    const bool low = support_.contains(center(bottom)), high = support_.contains(center(top - 1));
    if (low && high) add(bottom, top);
    if (low == high) return;
    // The one change in between, to the step.
    Steps before = bottom, after = top - 1;
    while (after - before > 1) {
      const Steps middle = before + (after - before) / 2;
      (support_.contains(center(middle)) == low ? before : after) = middle;
    }
    low ? add(bottom, after) : add(after, top);
  }

  void add(Steps bottom, Steps top) {
    if (!runs_.empty() && runs_.back().top == bottom)
      runs_.back().top = top;
    else
      runs_.push_back({bottom, top});
  }

  const Support& support_;
  Vec2 place_;
  double step_;
  Steps shortest_;
  std::vector<Run> runs_;
};

// Replaces what may be replaced within the run.
void fill(ColumnEditor& column, const Run& run, Steps floor, const FillParams& params) {
  if (params.replaces == kAllMaterials) {
    column.replace(run.bottom, run.top, params.material);
    return;
  }
  std::vector<Run> parts;
  const auto consider = [&](Material material, Steps bottom, Steps top) {
    bottom = std::max(bottom, run.bottom);
    top = std::min(top, run.top);
    if (bottom < top && params.replaces.contains(material)) parts.push_back({bottom, top});
  };
  Steps bottom = floor;
  for (const Layer& layer : column.layers()) {
    consider(layer.material(), bottom, layer.top());
    bottom = layer.top();
  }
  consider(Material::air, bottom, run.top);
  for (const Run& part : parts) column.replace(part.bottom, part.top, params.material);
}

// The columns whose centers lie in the range, at least partly.
std::pair<int, int> columns_within(double low, double high, double origin, double cell, int count) {
  const auto index = [&](double place) {
    return static_cast<int>(std::clamp((place - origin) / cell, 0.0, static_cast<double>(count)));
  };
  return {index(low), std::min(index(high) + 1, count)};
}

// The same without roughness; features along a column that are shorter than `shortest` metres may
// be missed.
Booking fill_columns(LayeredTerrain& terrain, const Support& support, const FillParams& params,
                     double shortest, Job* job) {
  const TerrainGrid& grid = terrain.grid();
  const Box3 box = support.bounds();
  if (box.empty()) return {};
  const auto [x_begin, x_end] =
      columns_within(box.min.x, box.max.x, grid.origin_x, grid.cell, grid.nx);
  const auto [y_begin, y_end] =
      columns_within(box.min.y, box.max.y, grid.origin_y, grid.cell, grid.ny);
  const double reach = double{kStepsMax} * grid.step;
  const Steps bottom = std::max(grid.floor, terrain.nearest_step(std::max(box.min.z, -reach)) - 1);
  const Steps top = terrain.nearest_step(std::min(box.max.z, reach)) + 1;
  const Steps shortest_steps = std::max(1, static_cast<Steps>(shortest / grid.step));

  return terrain.edit(
      {x_begin, y_begin, x_end, y_end},
      [&](int x, int y, ColumnEditor& column) {
        const Vec2 place(grid.origin_x + (x + 0.5) * grid.cell,
                         grid.origin_y + (y + 0.5) * grid.cell);
        ColumnRuns runs(support, place, grid.step, shortest_steps);
        for (const Run& run : runs.find(bottom, std::min(top, kStepsMax)))
          fill(column, run, grid.floor, params);
      },
      job);
}

}  // namespace

Booking fill_support(LayeredTerrain& terrain, const Support& support, const FillParams& params,
                     std::uint64_t seed, Job* job) {
  validate(params);
  const double shortest = kShortestCells * terrain.grid().cell;
  if (params.roughness == 0) return fill_columns(terrain, support, params, shortest, job);
  const RoughSupport rough(support, params.roughness, params.roughness_size, seed);
  const double finest_bump = kFinestShare * params.roughness_size;
  return fill_columns(terrain, rough, params, std::max(shortest, kShortestBumps * finest_bump),
                      job);
}

}  // namespace talus
