// Moving the surface of bedrock, dab by dab, as with a brush.
#pragma once

#include <vector>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/terrain/layered_terrain.h"
#include "talus/tools/stroke.h"

namespace talus {

// One touch of the brush. Its radius is between `kDabColumnsMin` and `kDabColumnsMax` columns.
struct DabParams {
  double radius = 4;
  double height = 0.5;
  bool carve = false;

  static void describe(auto& p, auto&& field) {
    field(p.radius, Field{.name = "radius",
                          .help = "how far a dab reaches; nothing beyond changes",
                          .unit = "m",
                          .min = 1e-3,
                          .max = 1e6});
    field(p.height,
          Field{.name = "height",
                .help = "how far a dab moves flat ground in its middle, at most a quarter of the "
                        "radius. The dabs of a stroke add up, to nearly four times that at a "
                        "spacing of 0.25, to twice at 0.5",
                .unit = "m",
                .min = 0,
                .max = 1e6});
    field(p.carve, Field{.name = "carve", .help = "take bedrock away instead of adding it"});
  }
};

constexpr double kDabColumnsMin = 2;
constexpr double kDabColumnsMax = 128;

// Moves the surface of the bedrock along its normal around a point near it ([Peytavie2009a] §4.1,
// with the guard for thin walls of [Peytavie2010] §2.2.1).
//
// The surface is that of the bedrock's field f with sigma nearest to half the radius R among the
// half-integer numbers of columns; or, where that shows none near the point as on thin walls, to
// half of it and so on, down to 1.5 columns. A dab adds or takes away s (1 - (r / R)^2)^2 around a
// center R / 2 below or above. s is such that flat ground moves by `height`. Each boundary of the
// bedrock in a column moves by the difference of the roots before and after, so that what f does
// not resolve stays: a dab of height 0 changes nothing, and no step farther than R from the center
// does. Between levels R / 32 apart f counts as linear.
//
// Throws `Error` (usage) for params out of range, and if the surface is farther from the point than
// sigma, or beyond the border.
Booking dab(LayeredTerrain& terrain, const Vec3& point, const DabParams& params,
            Job* job = nullptr);

struct StrokeParams {
  DabParams dab;
  double spacing = 0.25;

  static void describe(auto& p, auto&& field) {
    DabParams::describe(p.dab, field);
    field(p.spacing, Field{.name = "spacing",
                           .help = "distance between dabs along a stroke",
                           .unit = "radii",
                           .min = 0.01,
                           .max = 100});
  }
};

// Dabs along the line through the points, from the first to the last; each finds the surface that
// those before it have left. A point without z is on the topmost bedrock. Throws `Error` (usage) as
// `dab` and `places_along`, and for no points; then nothing has changed.
Booking sculpt(LayeredTerrain& terrain, const std::vector<SurfacePoint>& points,
               const StrokeParams& params, Job* job = nullptr);

}  // namespace talus
