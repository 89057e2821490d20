// Bedrock that weathers to sand where a brush goes over it.
#pragma once

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/terrain/layered_terrain.h"
#include "talus/tools/brush.h"

namespace talus {

struct ErodeSurfaceParams {
  double depth = 0.5;
  double amount = 1;
  BrushParams brush;

  static void describe(auto& p, auto&& field) {
    field(p.depth, Field{.name = "depth",
                         .help = "how deep the brush reaches into bedrock in its middle",
                         .unit = "m",
                         .min = 0,
                         .max = 1e5});
    field(p.amount, Field{.name = "amount",
                          .help = "how much of that becomes sand; as hard as the brush is pressed",
                          .min = 0,
                          .max = 1});
    BrushParams::describe(p.brush, field);
  }
};

// Turns the uppermost steps of bedrock that lies open to the air, also under roofs, into as many
// steps of sand ([Peytavie2009a] §4.4, progressive erosion of the surface): `amount` of `depth`,
// times the mask and the brush, which is (1 - (r / R)^2)^2 at a distance r from a dab in space; of
// several the strongest. Dabs without z are on the topmost bedrock. Without a stroke all columns
// are eroded alike. Nothing is moved: the sand lies where the bedrock was.
//
// Throws `Error` (usage) for params out of range and as `Brush`; then nothing has changed.
Booking erode_surface(LayeredTerrain& terrain, const BrushRegion& region,
                      const ErodeSurfaceParams& params, Job* job = nullptr);

}  // namespace talus
