// Loose matter that lies on whatever is flat enough.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

struct CoverParams {
  Material material = Material::sand;
  double thickness = 0.3;
  std::optional<double> slope_max_deg;
  double from_height = -1e5;
  double to_height = 1e5;
  bool under_roofs = true;
  double patch_size = 10;
  double coverage = 1;

  static void describe(auto& p, auto&& field) {
    field(p.material, Field{.name = "material", .help = "what is laid down: sand, soil or snow"});
    field(p.thickness, Field{.name = "thickness",
                             .help = "how thick it lies on level ground",
                             .unit = "m",
                             .min = 0,
                             .max = 1e4});
    field(p.slope_max_deg,
          Field{.name = "slope_max_deg",
                .help = "steepest ground it stays on; left out, the material's repose angle",
                .unit = "degrees",
                .min = 0,
                .max = 90});
    field(p.from_height,
          Field{.name = "from_height", .help = "only ground above this", .unit = "m"});
    field(p.to_height, Field{.name = "to_height", .help = "only ground below this", .unit = "m"});
    field(p.under_roofs, Field{.name = "under_roofs",
                               .help = "whether it also lies in caves and below overhangs"});
    field(p.patch_size, Field{.name = "patch_size",
                              .help = "size of the patches it lies in where it does not cover all",
                              .unit = "m",
                              .min = 1e-3,
                              .max = 1e6});
    field(p.coverage, Field{.name = "coverage",
                            .help = "share of the ground that it covers, in patches",
                            .min = 0,
                            .max = 1});
  }
};

// Lays a material on every upward surface of solid or granular ground that is less steep than the
// limit; it thins out toward the limit and never exceeds the air there. Rocks stay bare, since the
// stones that fill them leave gaps under whatever would lie on top. Slopes are measured between the
// neighboring columns' nearest surfaces, that below rocks for one, before anything is laid. Throws
// `Error` (usage) for params out of range.
Booking cover(LayeredTerrain& terrain, const CoverParams& params, std::uint64_t seed,
              Job* job = nullptr);

}  // namespace talus
