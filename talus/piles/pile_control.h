// What an author decides about a pile beyond the support: by region, or stone by stone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "talus/base/vec.h"
#include "talus/field/support.h"

namespace talus {

// Names a stone of a tiling, whatever is chosen of it: the cell of its seed in the infinite lattice
// and which of the cell's seeds it is.
struct StoneId {
  Int3 cell{0};
  int seed = 0;
  bool operator==(const StoneId&) const = default;
};

// Turned about its pivot, first about x, then y, then z, and moved.
struct StoneMove {
  StoneId stone;
  Vec3 by{0};          // m
  Vec3 rotate_deg{0};  // degrees
};

// Shares of the stones to keep, over a rectangle of the plan: row by row from the south, each from
// the west; 0 outside.
struct DensityMask {
  Box2 area;
  int nx = 0;
  int ny = 0;
  std::vector<float> shares;
};

struct PileControl {
  const Support* keep_out = nullptr;  // no anchor of a stone lies in it; null: nothing
  std::optional<DensityMask> density;
  std::vector<StoneId> removed;
  std::vector<StoneId> locked;  // stays, whatever else says that it does not
  std::vector<StoneMove> moved;
};

}  // namespace talus
