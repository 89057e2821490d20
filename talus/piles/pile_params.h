// How a support is filled with stones.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "talus/base/describe.h"

namespace talus {

// What decides whether a stone lies in a support: the share of its voxels' centers and its seed
// that do ([Peytavie2009] section 6), or its seed alone ([Peytavie2009a] section 5).
enum class Membership { anchors, center };

// Where the tiling lies, turned first about x, then y, then z.
struct TilingParams {
  std::optional<Vec3> at;
  Vec3 rotate_deg{0};

  static void describe(auto& p, auto&& field) {
    field(p.at, Field{.name = "at",
                      .help = "corner of a cell; without it the lower corner of the support",
                      .unit = "m",
                      .min = -1e9,
                      .max = 1e9});
    field(p.rotate_deg,
          Field{.name = "rotate_deg",
                .help = "turns about the x, y and z axes, in this order, so that stones bedded in "
                        "the tiling follow a slope or a wall",
                .unit = "degrees",
                .min = -360,
                .max = 360});
  }
};

struct PileParams {
  RelativeLength stone_size{0.04, RelativeLength::Unit::fraction};
  TilingParams tiling;
  Membership membership = Membership::anchors;
  double inside_fraction = 0.5;
  bool surface_only = false;
  double surface_depth = 3;
  double density = 1;
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  // bytes that choosing may take; no key

  static void describe(auto& p, auto&& field) {
    field(p.stone_size,
          Field{.name = "stone_size",
                .help = "edge of a tile cell: a length, or a share of the support's longest side",
                .unit = "m",
                .min = 1e-6});
    field(p.tiling, Field{.name = "tiling", .help = "where the tiling lies"});
    field(p.membership,
          Field{.name = "membership",
                .help = "what decides whether a stone lies inside: its anchors, which are its "
                        "voxels' centers and its seed, or its seed, the center, alone"});
    field(p.inside_fraction,
          Field{.name = "inside_fraction",
                .help = "of its anchors a stone needs at least this share inside",
                .min = 0.001,
                .max = 1});
    field(p.surface_only, Field{.name = "surface_only",
                                .help = "leave out stones that cannot be seen from outside"});
    field(p.surface_depth,
          Field{.name = "surface_depth",
                .help = "with surface_only: stones whose pivot lies deeper than this are left out",
                .unit = "mean stone radii",
                .min = 1,
                .max = 100});
    field(p.density, Field{.name = "density",
                           .help = "share of the stones that are kept, drawn one by one",
                           .min = 0,
                           .max = 1});
  }
};

}  // namespace talus
