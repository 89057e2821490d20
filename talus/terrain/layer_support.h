// Layers of a terrain as a support, to be filled with stones.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "talus/field/support.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

// A point is inside if it lies in a layer of one of the materials. Neither the open air nor the
// bedrock below the floor is a layer.
class LayerSupport final : public Support {
 public:
  // Throws `Error` (usage) if the terrain has no such layer.
  LayerSupport(LayeredTerrain terrain, const MaterialSet& materials);

  bool contains(const Vec3& p) const override;
  // Exact: `mixed` only if the box holds points of both kinds.
  BoxState classify(const Box3& box) const override;
  std::uint64_t contains_block(const PointBlock& block) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  // The columns that have such a layer, from the lowest to the highest of them.
  Box3 bounds() const override { return bounds_; }

 private:
  // Steps [begin, end) without which nothing is inside.
  struct Span {
    Steps begin = kStepsMax + 1;
    Steps end = -kStepsMax - 1;
    void include(const Span& s) {
      begin = std::min(begin, s.begin);
      end = std::max(end, s.end);
    }
  };
  // Steps from `begin` to `last`, and which kinds of layers they meet.
  struct Range {
    Steps begin = 0;
    Steps last = 0;
    bool any_inside = false;
    bool any_outside = false;
    BoxState state() const;
  };
  ColumnArea columns_of(const Box2& plan) const;
  BlockStates look_up(const ColumnArea& columns, std::array<Range, 4> ranges) const;
  void look(const ColumnArea& columns, std::span<Range> ranges) const;
  void look_into_column(int x, int y, std::span<Range> ranges) const;
  Range range(double bottom, double top) const;
  void summarize();
  std::size_t block_of(int x, int y) const;

  LayeredTerrain terrain_;
  MaterialSet materials_;
  std::vector<Span> blocks_;  // of squares of columns
  Box3 bounds_;
};

}  // namespace talus
