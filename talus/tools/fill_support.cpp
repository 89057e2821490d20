#include "talus/tools/fill_support.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "talus/tools/fill_run.h"
#include "talus/tools/roughness.h"

namespace talus {
namespace {

// Along a column places are asked so close together: in cells, and in sizes of the finest bumps.
constexpr double kShortestCells = 0.125;
constexpr double kShortestBumps = 0.5;

// A support whose surface is moved by noise.
class RoughSupport final : public Support {
 public:
  RoughSupport(const Support& support, const Roughness& roughness)
      : support_(support), roughness_(roughness) {}

  bool contains(const Vec3& p) const override { return support_.contains(p + roughness_.shift(p)); }
  BoxState classify(const Box3& box) const override {
    return support_.classify(box.expanded(roughness_.most()));
  }
  std::optional<Clearance> clearance(const Vec3& p) const override {
    // Most places are too far from the surface for the noise to matter.
    const std::optional<Clearance> smooth = support_.clearance(p);
    if (!smooth) return {};
    const double left = smooth->radius - roughness_.most();
    return left > 0 ? Clearance{smooth->inside, left} : Clearance{contains(p), 0};
  }
  Box3 bounds() const override { return support_.bounds().expanded(roughness_.most()); }

 private:
  const Support& support_;
  const Roughness& roughness_;
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

  // Of the steps [bottom, top). A change between the last place asked and `top` may be missed.
  const std::vector<Run>& find(Steps bottom, Steps top) {
    runs_.clear();
    if (bottom >= top) return runs_;
    Reach here = reach(bottom, top);
    for (Steps z = bottom;;) {
      const Steps next = std::min(z + here.steps, top);
      if (next == top) {
        add(here, z, top);
        return runs_;
      }
      const Reach there = reach(next, top);
      // Beyond what is certain, places so close together have at most one change between them.
      const Steps end =
          here.certain || here.inside == there.inside ? next : change(z, next, here.inside);
      add(here, z, end);
      add(there, end, next);
      z = next;
      here = there;
    }
  }

 private:
  // From a step upward, so many steps are alike; for certain, or as far as one looks.
  struct Reach {
    bool inside = false;
    bool certain = false;
    Steps steps = 1;
  };

  void add(const Reach& reach, Steps bottom, Steps top) {
    if (!reach.inside || bottom == top) return;
    if (runs_.empty() || runs_.back().top != bottom) runs_.push_back({bottom, bottom});
    runs_.back().top = top;
  }

  Vec3 center(Steps z) const { return {place_, (z + 0.5) * step_}; }
  bool contains(Steps z) const { return support_.contains(center(z)); }

  Reach reach(Steps z, Steps top) const {
    if (const auto clear = support_.clearance(center(z))) {
      const double steps = std::min(std::floor(clear->radius / step_), double{kStepsMax});
      if (steps > shortest_) return {clear->inside, true, static_cast<Steps>(steps)};
      return {clear->inside, false, shortest_};
    }
    // The longest certain box, by doubling.
    Reach found{contains(z), false, shortest_};
    const BoxState alike = found.inside ? BoxState::inside : BoxState::outside;
    for (Steps length = shortest_;; length *= 2) {
      length = std::min(length, top - z);
      if (support_.classify({center(z), center(z + length - 1)}) != alike) return found;
      found = {found.inside, true, length};
      if (length == top - z) return found;
    }
  }

  // The first step above `z` that differs from it, if the one at `other` does.
  Steps change(Steps z, Steps other, bool inside) const {
    while (other - z > 1) {
      const Steps middle = z + (other - z) / 2;
      (contains(middle) == inside ? z : other) = middle;
    }
    return other;
  }

  const Support& support_;
  Vec2 place_;
  double step_;
  Steps shortest_;
  std::vector<Run> runs_;
};

// The same without roughness; features along a column that are shorter than `shortest` metres may
// be missed.
Booking fill_columns(LayeredTerrain& terrain, const Support& support, const FillParams& params,
                     double shortest, Job* job) {
  const TerrainGrid& grid = terrain.grid();
  const Box3 box = support.bounds();
  if (box.empty()) return {};
  const double reach = double{kStepsMax} * grid.step;
  const Steps bottom = std::max(grid.floor, terrain.nearest_step(std::max(box.min.z, -reach)) - 1);
  const Steps shortest_steps =
      static_cast<Steps>(std::clamp(shortest / grid.step, 1.0, double{kStepsMax} / 2));
  // So far up that the last place asked lies above the support.
  const Steps top =
      std::min(terrain.nearest_step(std::min(box.max.z, reach)), kStepsMax - shortest_steps - 1) +
      shortest_steps + 1;

  return terrain.edit(
      grid.columns_within(Vec2(box.min), Vec2(box.max)),
      [&](int x, int y, ColumnEditor& column) {
        const Vec2 place = grid.center(x, y);
        ColumnRuns runs(support, place, grid.step, shortest_steps);
        for (const Run& run : runs.find(bottom, top))
          fill_run(column, run.bottom, run.top, params.material, params.replaces);
      },
      job);
}

}  // namespace

Booking fill_support(LayeredTerrain& terrain, const Support& support, const FillParams& params,
                     std::uint64_t seed, Job* job) {
  validate(params);
  const double shortest = kShortestCells * terrain.grid().cell;
  if (params.roughness == 0) return fill_columns(terrain, support, params, shortest, job);
  const Roughness roughness(params.roughness, params.roughness_size, seed);
  return fill_columns(terrain, RoughSupport(support, roughness), params,
                      std::max(shortest, kShortestBumps * roughness.finest_bump()), job);
}

}  // namespace talus
