// Strokes: where an author leads a brush over the terrain.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "talus/base/vec.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

// A place in space, or on the terrain seen from above.
struct SurfacePoint {
  Vec2 at{0};
  std::optional<double> z;
};

constexpr int kDabsMax = 1'000'000;

// The places of the dabs along the line through the points: the first point, then one every `step`
// metres. Between two points with z the line runs in space, else in the plan, where dabs have no z.
// Throws `Error` (usage) for a coordinate that is not finite, and for more than `kDabsMax` dabs;
// messages begin with the tool's name.
std::vector<SurfacePoint> places_along(const std::vector<SurfacePoint>& points, double step,
                                       std::string_view tool);

// Throws `Error` (usage) if a place is beyond the border.
void check_inside(const TerrainGrid& grid, const Vec2& at, std::string_view tool);

// Where the topmost bedrock of a place ends, in metres; beyond the border that of the nearest
// column.
double top_of_bedrock(const LayeredTerrain& terrain, const Vec2& at);

}  // namespace talus
