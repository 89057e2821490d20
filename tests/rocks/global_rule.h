// Who owns a point of a tiling, by the rule of docs/rocks.md and nothing else: no intervals, blocks
// or windows, only seeds and how far each may reach. In double precision.
#pragma once

#include <cmath>
#include <vector>

#include "rocks/tiling.h"
#include "talus/rocks/seeds.h"

namespace talus::test {

class GlobalRule {
 public:
  struct Claim {
    Int3 cell{0};
    int seed = -1;
    double score = std::numeric_limits<double>::infinity();  // d / phi in squared voxels
  };

  // For voxels of the cubes `first` to `last`, the end excluded.
  GlobalRule(const TileParams& params, const rocks::SeedTable& seeds, const Tiling& tiling,
             const Int3& first, const Int3& last)
      : params_(params),
        period_(params.n - 1),
        voxels_(params.voxels() / params.n),
        radius_(fixed_radius(params)),
        min_(period_ * (first - 1)),
        size_(period_ * (last - first + 2)) {
    for_each_cell(min_, min_ + size_,
                  [&](const Int3& cell) { seeds_.push_back(tiling.seeds(seeds, cell)); });
  }

  // The claim with the least score at a voxel's center; `asked` gets the score of the claim of one
  // seed, infinite where it may not reach.
  Claim strongest(const Int3& voxel, const Int3& asked_cell, int asked_seed, double& asked) const {
    const Vec3 p = (Vec3(voxel) + 0.5) / static_cast<double>(voxels_);
    for (int axis = 0; axis < 3; ++axis) find_reaching(axis, p[axis], reaching_[axis]);
    Claim best;
    asked = best.score;
    for (const Reaching& z : reaching_[2])
      for (const Reaching& y : reaching_[1])
        for (const Reaching& x : reaching_[0]) {
          const Int3 cell(x.cell, y.cell, z.cell);
          const double phi = std::min({x.phi, y.phi, z.phi});
          const auto& seeds = seeds_at(cell);
          for (std::size_t k = 0; k < seeds.size(); ++k) {
            const double score = distance(seeds[k], (p - Vec3(cell)) * Vec3(voxels_)) / phi;
            if (score < best.score) best = {cell, static_cast<int>(k), score};
            if (cell == asked_cell && static_cast<int>(k) == asked_seed) asked = score;
          }
        }
    return best;
  }

 private:
  struct Reaching {
    int cell;
    double phi;
  };

  // The cells that may reach a coordinate, and how much of a claim they have there.
  void find_reaching(int axis, double x, std::vector<Reaching>& out) const {
    out.clear();
    const int cell = static_cast<int>(std::floor(x));
    for (int c = cell - period_; c <= cell + period_; ++c) {
      const int q = floor_div(c, period_);
      const auto [low, high] = reach(axis, c - q * period_);
      const double u = std::min(x - (q * period_ + low), q * period_ + high - x);
      const double t = std::min(u / (radius_ / 4.0), 1.0);
      if (t > 0) out.push_back({c, t * t * (3 - 2 * t)});
    }
  }

  // Of a cell of index l, relative to its cube.
  std::pair<double, double> reach(int axis, int l) const {
    const double rho = radius_ / 2.0;
    if (repeats(params_.variety, axis)) {
      const double margin = std::floor((period_ - 1) * voxels_ / 2.0) / voxels_;
      return {l - margin, l + 1 + margin};
    }
    if (l == 0) return {-rho, 1 + rho};
    return {l <= radius_ ? -rho : 1 + rho,
            l < period_ - radius_ ? period_ - rho : period_ + 1 + rho};
  }

  static double distance(const rocks::Seed& s, const Vec3& at) {
    const Vec3 d = at - Vec3(s.position);
    return s.xx * d.x * d.x + s.yy * d.y * d.y + s.zz * d.z * d.z + s.xy * d.x * d.y +
           s.xz * d.x * d.z + s.yz * d.y * d.z;
  }

  const std::span<const rocks::Seed>& seeds_at(const Int3& cell) const {
    const Int3 at = cell - min_;
    return seeds_[static_cast<std::size_t>(at.x + size_.x * (at.y + size_.y * at.z))];
  }

  TileParams params_;
  int period_, voxels_, radius_;
  Int3 min_, size_;
  std::vector<std::span<const rocks::Seed>> seeds_;
  mutable std::vector<Reaching> reaching_[3];
};

}  // namespace talus::test
