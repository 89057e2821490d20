// Terrain that nobody measured.
#pragma once

#include <cstdint>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/base/vec.h"
#include "talus/field/height_grid.h"

namespace talus {

// Fractal heights about a plane. Lengths in metres, so that another cell size shows the same
// landscape.
struct NoiseTerrainParams {
  double height = 0;
  double relief = 10;
  double feature_size = 50;
  int octaves = 8;
  double gain = 0.5;
  double ridged = 0;
  double warp = 0;
  double warp_size = 0;
  double terrace = 0;
  double terrace_sharpness = 0.7;
  Vec2 grade{0};

  static void describe(auto& p, auto&& field) {
    field(p.height, Field{.name = "height",
                          .help = "height at the corner (0, 0) of the plane that the noise rises "
                                  "and falls about",
                          .unit = "m",
                          .min = -1e5,
                          .max = 1e5});
    field(p.relief, Field{.name = "relief",
                          .help = "largest rise above and fall below that plane, before it breaks "
                                  "into terraces",
                          .unit = "m",
                          .min = 0,
                          .max = 1e4});
    field(p.feature_size, Field{.name = "feature_size",
                                .help = "size of the largest hills",
                                .unit = "m",
                                .min = 1e-3,
                                .max = 1e6});
    field(p.octaves, Field{.name = "octaves",
                           .help = "how often finer noise is added, each time half as large",
                           .min = 1,
                           .max = 16});
    field(p.gain, Field{.name = "gain",
                        .help = "strength of each octave in that of the one before: roughness",
                        .min = 0,
                        .max = 1});
    field(p.ridged, Field{.name = "ridged",
                          .help = "from rolling hills (0) to sharp crests (1)",
                          .min = 0,
                          .max = 1});
    field(p.warp, Field{.name = "warp",
                        .help = "how far places are shifted by noise: winding, less regular forms",
                        .unit = "m",
                        .min = 0,
                        .max = 1e5});
    field(p.warp_size, Field{.name = "warp_size",
                             .help = "size of those shifts' noise; 0 is `feature_size`",
                             .unit = "m",
                             .min = 0,
                             .max = 1e6});
    field(p.terrace, Field{.name = "terrace",
                           .help = "height of steps that the slopes break into; 0 is none",
                           .unit = "m",
                           .min = 0,
                           .max = 1e4});
    field(p.terrace_sharpness,
          Field{.name = "terrace_sharpness",
                .help = "from soft waves (0) to flat steps with sharp edges (1)",
                .min = 0,
                .max = 1});
    field(p.grade, Field{.name = "grade",
                         .help = "rise of the plane for each metre to the east and to the north",
                         .min = -10,
                         .max = 10});
  }
};

// The height at the center of each of nx x ny cells whose south-west corner is (0, 0); a function
// of place, so that a larger grid has the same heights. Throws `Error` (usage) for params out of
// range.
HeightGrid noise_heights(int nx, int ny, double cell, const NoiseTerrainParams& params,
                         std::uint64_t seed, Job* job = nullptr);

}  // namespace talus
