// Solid forms cut out of a terrain or put into it.
#pragma once

#include <cstdint>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/field/support.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

struct FillParams {
  Material material = Material::air;
  MaterialSet replaces = kAllMaterials;
  double roughness = 0;
  double roughness_size = 1;

  static void describe(auto& p, auto&& field) {
    field(p.material, Field{.name = "material", .help = "what the form is filled with"});
    field(p.replaces, Field{.name = "replaces", .help = "the materials that make way for it"});
    field(p.roughness, Field{.name = "roughness",
                             .help = "how far noise moves the form's surface",
                             .unit = "m",
                             .min = 0,
                             .max = 1e4});
    field(p.roughness_size, Field{.name = "roughness_size",
                                  .help = "size of the largest bumps of that noise",
                                  .unit = "m",
                                  .min = 1e-3,
                                  .max = 1e6});
  }
};

// Fills what a support holds with a material: every step of a column whose center lies within, as
// far as the material there is one that may be replaced. Along a column, features thinner than an
// eighth of a cell may be missed. With roughness, places are shifted by noise, at most as far as it
// says, before the support is asked; features thinner than half the finest bumps may be
// missed then. Throws `Error` (usage) for params out of range.
Booking fill_support(LayeredTerrain& terrain, const Support& support, const FillParams& params,
                     std::uint64_t seed, Job* job = nullptr);

}  // namespace talus
