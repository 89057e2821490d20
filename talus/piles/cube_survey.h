// Which cubes of a tiling a support reaches.
#pragma once

#include <optional>
#include <vector>

#include "talus/piles/choice.h"

namespace talus::piles {

// The cubes of a tiling whose stones can lie within bounds: as doubles, for there may be more than
// integers can count.
struct CubeExtent {
  Vec3 first;
  Vec3 size;

  double volume() const { return size.x * size.y * size.z; }
};
CubeExtent cubes_around(const Box3& bounds, const Tiling& tiling, const TileSet& tiles);

// Cubes of `all` some of whose stones can lie in the support, in order of place; nothing if they
// are more than `cubes_max`.
struct CubeSurvey {
  std::optional<std::vector<Int3>> cubes;
  double filled_estimate = 0;  // about how many cubes the support fills
};
CubeSurvey survey_cubes(const ChoiceRule& rule, const CubeBox& all, std::uint64_t cubes_max);

}  // namespace talus::piles
