// What lies between two surfaces given as heights.
#pragma once

#include <vector>

#include "talus/field/height_grid.h"
#include "talus/field/support.h"

namespace talus {

// All points at or above one surface and at or below another, over the plan of two grids that
// cover the same cells. Between the middles of cells heights are interpolated bilinearly, beyond
// the outermost ones they go on level to the border. Where a height that takes part is unknown
// nothing is inside.
class HeightIntervalSupport final : public Support {
 public:
  // The plan's south-west corner is at (x, y) of `corner`. Throws `Error` (usage) if the grids
  // differ in size or cell, or leave no room between them.
  HeightIntervalSupport(const HeightGrid& lower, const HeightGrid& upper,
                        const Vec2& corner = Vec2(0));

  bool contains(const Vec3& p) const override;
  BoxState classify(const Box3& box) const override;
  std::uint64_t contains_block(const PointBlock& block) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  // Of the two surfaces somewhere: from the least to the greatest height of each.
  struct Heights {
    float lower_min, lower_max, upper_min, upper_max;
    void include(const Heights& other);
  };
  // Squares of 2^level samples.
  struct Level {
    int nx = 0;
    int ny = 0;
    std::vector<Heights> squares;
  };
  struct Interval {
    double lower, upper;
  };
  Interval at(const Vec2& p) const;
  Heights around(const Vec2& min, const Vec2& max) const;
  BoxState compare(const Heights& heights, double bottom, double top) const;
  bool covers(const Vec2& min, const Vec2& max) const;

  HeightGrid lower_, upper_;
  Vec2 corner_, far_corner_;
  std::vector<Level> levels_;
  Box3 bounds_;
};

}  // namespace talus
