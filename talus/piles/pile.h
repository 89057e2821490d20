// Filling a support with the stones of a tile set.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "talus/base/job.h"
#include "talus/field/support.h"
#include "talus/mesh/instance_table.h"
#include "talus/piles/cube_bits.h"
#include "talus/piles/pile_control.h"
#include "talus/piles/pile_params.h"
#include "talus/piles/tiling.h"
#include "talus/rocks/tile_set.h"

namespace talus {

// A stone at its place in the tiling: `cell` is where its seed's cell lies in the infinite lattice.
struct PlacedStone {
  Int3 cell;
  std::uint32_t stone;  // index into the tile set
};

// A stone that no longer lies where the tiling has it.
struct MovedStone {
  StoneId id;           // where it came from
  std::uint32_t stone;  // index into the tile set
  Vec3 position;        // of its pivot, m
  Quat rotation;        // unit
};

struct PileStats {
  std::uint64_t instances = 0;
  std::uint64_t unique = 0;    // distinct stones used
  std::uint64_t hidden = 0;    // left out by `surface_only`
  std::uint64_t isolated = 0;  // left out because they would touch no other stone
  std::uint64_t thinned = 0;   // left out by `density`
  // Voxels of the stones chosen, before any is left out, and of those whose seed lies in the region
  // to fill, which is about what the region could hold.
  std::uint64_t chosen_voxels = 0;
  std::uint64_t seeded_voxels = 0;

  // Share of the region that stays empty because no whole stone fits there.
  double gap_fraction() const {
    if (chosen_voxels >= seeded_voxels) return 0;
    return 1 - static_cast<double>(chosen_voxels) / static_cast<double>(seeded_voxels);
  }
};

// Stones of a tiling: a stone that lies where the tiling has it is one bit of its cube.
struct Pile {
  std::shared_ptr<const TileSet> tiles;
  Tiling tiling;
  double floor = 0;  // height that the lowest stones stand on, m
  CubeBits stones;
  std::vector<MovedStone> moved;
  PileStats stats;
};

// Places stones of a tiling, all or those of some cubes. Refers to its support and to what is kept
// out, which must outlive it.
class PileFiller {
 public:
  // Every stone of the tiling that lies in `support` by the rule of [Peytavie2009] section 6, as
  // `control` lets it. Without `params.tiling.at` the tiling starts at the lower corner of the
  // support's bounds, so that the lowest stones stand on a common level. Throws `Error` (usage) for
  // a support without bounds, parameters out of range, and control of stones that do not exist.
  PileFiller(const Support& support, std::shared_ptr<const TileSet> tiles,
             const PileParams& params = {}, const PileControl& control = {});
  ~PileFiller();

  const Tiling& tiling() const;
  // All cubes of which the pile can have stones; (n - 1)^3 cells each.
  const CubeBox& cubes() const;

  // The stones of these cubes, those that the whole pile has there. Throws `Error` (job), before
  // taking memory, if choosing takes more than `params.memory_limit`.
  Pile fill(const CubeBox& part, Job* job = nullptr) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

// The whole pile. Throws besides `Error` (usage) if the stones are too large for a single one to
// fit, and names the largest size that does.
Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles,
          const PileParams& params = {}, Job* job = nullptr);
Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles, const PileParams& params,
          const PileControl& control, Job* job = nullptr);

// Boxes that make up `all`, halved across their longest edge until none has more than `cubes_max`
// cubes.
std::vector<CubeBox> split(const CubeBox& all, std::uint64_t cubes_max);

// The stones that lie where the tiling has them, cube by cube.
std::vector<PlacedStone> placed_stones(const Pile& pile);

// All stones as instances of the tile set's meshes, which are shared, not copied.
InstanceTable instances(const Pile& pile);

}  // namespace talus
