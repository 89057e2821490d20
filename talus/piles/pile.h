// Filling a support with the stones of a tile set.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/field/support.h"
#include "talus/mesh/instance_table.h"
#include "talus/rocks/tile_set.h"

namespace talus {

struct PileParams {
  RelativeLength stone_size{0.04, RelativeLength::Unit::fraction};
  double inside_fraction = 0.5;
  bool surface_only = false;
  double surface_depth = 3;

  static void describe(auto& p, auto&& field) {
    field(p.stone_size,
          Field{.name = "stone_size",
                .help = "edge of a tile cell: a length, or a share of the support's longest side",
                .unit = "m",
                .min = 1e-6});
    field(
        p.inside_fraction,
        Field{.name = "inside_fraction",
              .help = "a stone is placed if at least this share of its voxel centers and its seed "
                      "lies inside the support",
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
  }
};

// A stone at its place: `cell` is where its seed's cell lies in the infinite lattice.
struct PlacedStone {
  Int3 cell;
  std::uint32_t stone;  // index into the tile set
};

struct PileStats {
  std::uint64_t instances = 0;
  std::uint64_t unique = 0;    // distinct stones used
  std::uint64_t hidden = 0;    // left out by `surface_only`
  std::uint64_t isolated = 0;  // left out because they would touch no other stone
  double contacts_mean = 0;    // per placed stone, with stones of the pile, hidden ones included
};

// Stones of a tiling whose cell (0, 0, 0) has its lower corner at `origin` and edges of `cell_size`
// metres. Sorted by cell (z, then y, then x), then by seed.
struct Pile {
  std::shared_ptr<const TileSet> tiles;
  Vec3 origin{0};
  double cell_size = 1;
  std::vector<PlacedStone> stones;
  PileStats stats;
};

// Places every stone of the tiling that lies in `support` by the rule of [Peytavie2009] section 6.
// The tiling starts at the lower corner of the support's bounds, so that the lowest stones stand on
// a common level. Throws `Error` (usage) if the stones are too large for a single one to fit, and
// names the largest size that does.
Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles,
          const PileParams& params = {}, Job* job = nullptr);

// The pile's stones as instances of the tile set's meshes, which are shared, not copied.
InstanceTable instances(const Pile& pile);

}  // namespace talus
