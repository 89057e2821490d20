// Matter dropped from a brush, or taken away with it.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/field/height_grid.h"
#include "talus/terrain/layered_terrain.h"
#include "talus/tools/brush.h"

namespace talus {

// How thick a dab lies at a distance r from its middle, of a radius R, as a share of its height.
enum class DepositProfile {
  constant,  // 1
  cone,      // 1 - r / R
  dome,      // 1 - (r / R)^2
  noise,     // a dome, broken up by noise that depends on the place alone
  map,       // a map of heights, stretched over the square of 2 R, north up
};

struct DepositParams {
  Material material = Material::sand;
  bool remove = false;
  std::optional<double> height;
  std::optional<double> volume;
  DepositProfile profile = DepositProfile::dome;
  BrushParams brush;
  double noise_size = 2;
  HeightGrid map;  // of that profile; no key

  static void describe(auto& p, auto&& field) {
    field(p.material, Field{.name = "material", .help = "what is dropped, or taken away"});
    field(p.remove, Field{.name = "remove",
                          .help = "take away as much of the material as shows at the surface, "
                                  "instead of dropping it"});
    field(p.height, Field{.name = "height",
                          .help = "how thick it lies where it is thickest",
                          .unit = "m",
                          .min = 0,
                          .max = 1e5});
    field(p.volume, Field{.name = "volume",
                          .help = "how much it is in all, instead of `height`",
                          .unit = "m^3",
                          .min = 0,
                          .max = 1e15});
    field(p.profile, Field{.name = "profile",
                           .help = "form of a dab: as thick everywhere, a cone, a dome, a dome "
                                   "broken up by noise, or the heights of `map`"});
    BrushParams::describe(p.brush, field);
    field(p.noise_size, Field{.name = "noise_size",
                              .help = "size of the heaps that noise makes",
                              .unit = "m",
                              .min = 1e-3,
                              .max = 1e6});
  }
};

// Throws `Error` (usage) for params out of range, air, and not exactly one of height and volume.
void validate_deposit(const DepositParams& params);

// Drops a material along a stroke as thick as the profile says times the mask, or takes it away
// ([Peytavie2010] §2.3.1). Without points each column is the middle of a dab from the sky.
//
// A dab without z falls from the sky onto the highest surface. One with z falls, in each column,
// onto the first surface below that height, or comes on top of the loose matter that z lies in; a
// column where z is in bedrock gets none. Never more is added than there is air above that surface,
// nor more removed than the layer below it holds if that is of the material. What is put down stays
// where it is. Dabs do not add up: where several reach one surface, the thickest counts.
//
// With `height` each thickness is rounded to the nearest step. With `volume` thicknesses are such
// that their sum is the volume, to the step: in proportion to the profile, or all there is room
// for, where that is less. What found no room at all is missing in the booking.
//
// Throws `Error` (usage) as `validate_deposit`, for a map that is flat, not wholly known or without
// points, and as `Brush`; then nothing has changed.
Booking deposit(LayeredTerrain& terrain, const BrushRegion& region, const DepositParams& params,
                std::uint64_t seed, Job* job = nullptr);

// What a volume is in steps of that grid's columns.
std::int64_t steps_of_volume(const TerrainGrid& grid, double volume);

}  // namespace talus
