// The ground's upper surface from a map of heights.
#pragma once

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/field/height_grid.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

enum class SurfaceChange {
  set,    // all below becomes full, all above becomes air
  raise,  // air above the highest layer is filled up to the surface; nothing is cut
  lower,  // what stands above the surface becomes air; nothing is filled
};

struct SetSurfaceParams {
  SurfaceChange change = SurfaceChange::set;
  Material material = Material::bedrock;
  int x_begin = 0;  // the column of the heights' south-west cell; no key
  int y_begin = 0;

  static void describe(auto& p, auto&& field) {
    field(p.change, Field{.name = "change",
                          .help = "\"set\" fills below the heights and clears above them, "
                                  "\"raise\" only adds on top, \"lower\" only takes away"});
    field(p.material, Field{.name = "material", .help = "what is filled in"});
  }
};

// Brings each column to the height of the cell above it, rounded to the nearest step; cells that
// are missing or unknown leave their column as it is. Throws `Error` (usage) if the cells differ in
// size, and for heights beyond what steps can count.
Booking set_surface(LayeredTerrain& terrain, const HeightGrid& heights,
                    const SetSurfaceParams& params = {}, Job* job = nullptr);

// A floor that leaves room to dig: a tenth of the longest side below the lowest height. Throws
// `Error` (usage) if steps cannot count so far.
Steps floor_below(double lowest, const TerrainGrid& grid);

// A terrain of those columns over such a floor, bedrock up to the heights; unknown cells are open
// down to the floor. Throws `Error` (usage).
LayeredTerrain make_terrain(const HeightGrid& heights, double step = TerrainGrid{}.step,
                            Job* job = nullptr);

}  // namespace talus
