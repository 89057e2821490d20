// What an author chooses about a set of rock tiles.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/describe.h"

namespace talus {

struct ContactParams {
  double radius = 0.14;
  double blend = 0.30;
  std::optional<double> gaussian_radius;
  double discard_fraction = 0;

  static void describe(auto& p, auto&& field) {
    field(p.radius, Field{.name = "radius",
                          .help = "no weathering this close to where two stones touch. Less around "
                                  "stones that share a cell, as they are smaller, and around round "
                                  "ones: half of it at roundness 1",
                          .unit = "cells",
                          .min = 0,
                          .max = 1});
    field(p.blend, Field{.name = "blend",
                         .help = "full weathering from this distance on; at least `radius`",
                         .unit = "cells",
                         .min = 0,
                         .max = 2});
    field(p.gaussian_radius,
          Field{.name = "gaussian_radius",
                .help = "in place of `radius` and `blend`: weathering is held off by a Gaussian of "
                        "this radius around where two stones touch",
                .unit = "cells",
                .min = 0.01,
                .max = 1});
    field(p.discard_fraction,
          Field{.name = "discard_fraction",
                .help = "share of the contacts that weathering does not spare; makes room between "
                        "stones, some of which may float",
                .min = 0,
                .max = 1});
  }
};

struct WeatheringParams {
  double depth = 0.1;
  double variation = 0;
  double roundness = 0;
  std::optional<double> void_fraction;

  static void describe(auto& p, auto&& field) {
    field(p.depth, Field{.name = "depth",
                         .help = "how far an open flat face recedes; edges and corners lose more. "
                                 "0 leaves sharp stones. Less on stones that share a cell",
                         .unit = "cells",
                         .min = 0,
                         .max = 0.5});
    field(
        p.variation,
        Field{.name = "variation",
              .help = "how uneven `depth` is: by this share more or less, from stone to stone and "
                      "over each stone",
              .min = 0,
              .max = 1});
    field(p.roundness,
          Field{.name = "roundness",
                .help =
                    "from 0, angular, to 1, river pebbles: edges and corners go, and faces recede "
                    "by less, down to a quarter of `depth`",
                .min = 0,
                .max = 1});
    field(
        p.void_fraction,
        Field{.name = "void_fraction",
              .help = "in place of `depth`: share of space to leave between stones. What cannot be "
                      "reached is told",
              .min = 0,
              .max = 0.95});
  }
};

enum class Variety {
  aperiodic,  // a color at every corner of the lattice of cubes
  columns,    // a color at every vertical line of corners: what lies above a cube is the same cube
  periodic,   // one cube everywhere ([Peytavie2009a] section 5)
};

// Whether tiles of a variety repeat with every cube along an axis, whatever the corners' colors.
constexpr bool repeats(Variety variety, int axis) {
  return variety == Variety::periodic || (variety == Variety::columns && axis == 2);
}

enum class SeedPlacement {
  low_discrepancy,  // evenly spread in each cell, as if the others were not there
  poisson,          // at random, at a distance from the seeds around ([Lagae2006])
};

enum class Frames {
  random,  // turned any way
  bedded,  // their third axes along `bedding`, so that slabs lie flat
};

// Lengths are in cells: one cell is one unit until the tiles are placed.
struct TileParams {
  Variety variety = Variety::aperiodic;
  int n = 5;
  std::optional<int> voxels_per_edge;
  int colors = 2;
  int seeds_min = 1;
  int seeds_max = 1;
  SeedPlacement placement = SeedPlacement::low_discrepancy;
  double size_ratio = 2;
  Range axis_x{1, 1};
  Range axis_y{1, 1};
  Range axis_z{1, 1};
  Frames frames = Frames::random;
  Vec3 bedding{0, 0, 1};
  double bedding_spread_deg = 10;
  ContactParams contacts;
  WeatheringParams weathering;

  int voxels() const { return voxels_per_edge.value_or(10 * n); }

  static void describe(auto& p, auto&& field) {
    field(p.variety,
          Field{.name = "variety",
                .help = "how stones repeat: nowhere; upwards only, in a tenth of the memory; or "
                        "in every direction"});
    field(p.n, Field{.name = "n",
                     .help = "cells along the edge of a corner cube",
                     .unit = "cells",
                     .min = 5,
                     .max = 16});
    field(p.voxels_per_edge, Field{.name = "voxels_per_edge",
                                   .help = "resolution; a multiple of 2 n (of n if n is 7, 8, 11, "
                                           "12, 15 or 16), 10 n if not given",
                                   .unit = "voxels",
                                   .min = 20,
                                   .max = 1024});
    field(p.colors,
          Field{.name = "colors",
                .help = "corner colors; more of them repeat less. A periodic set needs none",
                .min = 2,
                .max = 3});
    field(p.seeds_min,
          Field{.name = "seeds_min", .help = "fewest stones in a cell", .min = 1, .max = 64});
    field(p.seeds_max,
          Field{.name = "seeds_max",
                .help = "most stones in a cell; above seeds_min gravel mixes with rocks",
                .min = 1,
                .max = 64});
    field(p.placement,
          Field{.name = "placement",
                .help = "how the seeds that stones grow from are spread: evenly in each cell, or "
                        "at random but apart from each other"});
    field(p.size_ratio,
          Field{.name = "size_ratio",
                .help = "how uneven in size the stones of one cell size are; 1 makes them even",
                .min = 1,
                .max = 4});
    field(p.axis_x, Field{.name = "axis_x",
                          .help = "relative extent of a stone along its first axis",
                          .min = 0.1,
                          .max = 10});
    field(p.axis_y,
          Field{.name = "axis_y", .help = "along its second axis", .min = 0.1, .max = 10});
    field(p.axis_z, Field{.name = "axis_z",
                          .help = "along its third axis; small makes slabs",
                          .min = 0.1,
                          .max = 10});
    field(p.frames, Field{.name = "frames",
                          .help = "how stones are turned: any way, or with their third axes along "
                                  "`bedding`, so that slabs lie flat"});
    field(p.bedding,
          Field{.name = "bedding", .help = "direction across the beds", .min = -1e6, .max = 1e6});
    field(p.bedding_spread_deg, Field{.name = "bedding_spread_deg",
                                      .help = "how far a stone's third axis may turn from it",
                                      .unit = "degrees",
                                      .min = 0,
                                      .max = 90});
    field(p.contacts, Field{.name = "contacts", .help = "where stones keep touching"});
    field(p.weathering, Field{.name = "weathering", .help = "how worn the stones are"});
  }
};

// Cells on either side of a corner that its color fixes ([Peytavie2009] section 3, generalised).
inline int fixed_radius(const TileParams& p) { return (p.n - 3) / 2; }

// Whether the set takes no more memory while it is made than is allowed.
bool fits_memory(const TileParams& params);

// Throws `Error` (usage): ranges, and the relations between fields that ranges cannot say.
void validate_tiles(const TileParams& params);

}  // namespace talus
