// Where a brush works: near the dabs of a stroke, and as a painted mask lets it.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "talus/base/describe.h"
#include "talus/tools/stroke.h"

namespace talus {

// How strongly a tool works on each column, 0 to 1; row by row from the south, each from the west.
struct ColumnMask {
  int nx = 0;
  int ny = 0;
  std::vector<float> shares;
};

// Near a stroke; without points everywhere. Where there is a mask, as it says.
struct BrushRegion {
  std::vector<SurfacePoint> points;
  std::optional<ColumnMask> mask;
};

struct BrushParams {
  double radius = 4;
  double spacing = 0.1;

  static void describe(auto& p, auto&& field) {
    field(p.radius, Field{.name = "radius",
                          .help = "how far a dab reaches; nothing beyond changes",
                          .unit = "m",
                          .min = 1e-3,
                          .max = 1e6});
    field(p.spacing, Field{.name = "spacing",
                           .help = "distance between dabs along a stroke",
                           .unit = "radii",
                           .min = 0.01,
                           .max = 100});
  }
};

// The dabs of a region's stroke, found by column, and its mask. The region must stay as long.
class Brush {
 public:
  // Throws `Error` (usage), beginning with the tool's name, for a region of neither points nor
  // mask, points as `places_along` and `check_inside`, dabs that reach more than 4e9 columns in
  // all, and a mask that has not a share from 0 to 1 for each column.
  Brush(const TerrainGrid& grid, const BrushRegion& region, const BrushParams& params,
        std::string_view tool);

  // Gives the dabs without z that of the topmost bedrock.
  void lay_on_bedrock(const LayeredTerrain& terrain);

  double radius() const { return radius_; }
  // Columns that may be reached.
  const ColumnArea& area() const { return area_; }
  Vec2 axis(int x, int y) const { return grid_.center(x, y); }

  bool everywhere() const { return by_tile_.empty(); }
  // All that may reach a column, and some that do not, in the order of the stroke; unless it works
  // everywhere.
  std::span<const SurfacePoint> dabs_near(int x, int y) const;
  double mask(int x, int y) const;

 private:
  std::size_t tile_of(int x, int y) const;

  TerrainGrid grid_;
  const ColumnMask* mask_;  // or null
  double radius_;
  ColumnArea area_;
  std::vector<std::vector<SurfacePoint>> by_tile_;
};

}  // namespace talus
