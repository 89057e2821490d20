// A set of stones that tile space without repeating, made once and placed anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/stage.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/rocks/tile_params.h"

namespace talus {

namespace rocks {
class SeedTable;
struct CellLayout;
struct MadeStone;
struct StoneKey;
}  // namespace rocks

// Voxels of one stone, relative to the corner of its seed's cell: bit x + size.x (y + size.y z) of
// `bits` says whether voxel `min + (x, y, z)` belongs to it.
struct StoneSolid {
  Int3 min{0};
  Int3 size{0};
  std::vector<std::uint64_t> bits;

  bool test(int x, int y, int z) const {
    const auto i = static_cast<std::size_t>(x + size.x * (y + size.y * z));
    return bits[i / 64] >> (i % 64) & 1;
  }
};

// Where a stone touches a neighbour.
struct StoneContact {
  Int3 cell;           // of the neighbour's seed, in cells relative to the stone's
  std::uint16_t seed;  // which of that cell's seeds
  bool kept;           // whether this stone's voxel behind the face survived weathering
  Int3 face;  // middle of the shared voxel face, in half voxels relative to the stone's cell
};

// One stone as every compatible tiling contains it. Lengths are in cells, positions relative to
// the corner of its seed's cell.
struct Stone {
  Int3 cell;             // 0 <= cell < n - 1, in its cube
  std::uint16_t seed;    // which of the cell's seeds
  std::uint32_t colors;  // corner colors it depends on, base `colors`, x fastest
  Vec3 seed_position{0};
  Vec3 pivot{0};                  // origin of its mesh: the middle of its solid
  double volume = 0;              // of the weathered solid, cubic cells
  double radius = 0;              // of the smallest ball around the pivot that holds its mesh
  std::uint64_t voxel_count = 0;  // before weathering
  StoneSolid solid;               // after weathering; empty if nothing is left
  std::vector<StoneContact> contacts;
  std::shared_ptr<const TriangleMesh> mesh;  // relative to the pivot; null if nothing is left
};

struct TileStats {
  std::uint64_t empty = 0;  // stones weathered away or without a voxel
  std::uint64_t distinct_meshes = 0;
  std::uint64_t fragments_removed = 0;  // voxels that weathering had cut off
  double seed_spacing = 0;  // the least distance between two seeds of any tiling, in cells
  // Share of space, on average over all tilings, where a seed too far away to compete could be
  // nearer than the owner's; if that is above 5 %, the least n up to 9 that would leave less.
  double deviation_bound = 0;
  std::optional<int> sufficient_n;
  double void_fraction = 0;  // of space, averaged over all blocks a tiling can contain
  double contacts_mean = 0;  // kept, per stone that is not empty; only `fill` knows both sides
  std::uint64_t contacts_min = 0;
  double contacts_lost_fraction = 0;
  double below_three_fraction = 0;  // stones with fewer than three contacts
  std::uint64_t triangles = 0;
};

// Colors of a cube's corners: entry x + 2 y + 4 z.
using CornerColors = std::array<std::uint8_t, 8>;

class TileSet {
 public:
  // Every color at every corner, as the variety has them; see docs/rocks.md for the construction.
  // Appends what each phase of it cost to `phases`.
  static TileSet make(const TileParams& params, std::uint64_t seed, Job* job = nullptr,
                      std::vector<Stage>* phases = nullptr);

  const TileParams& params() const { return params_; }
  std::uint64_t seed() const { return seed_; }
  std::span<const Stone> stones() const { return stones_; }
  const TileStats& stats() const { return stats_; }

  // Indices of the stones of one cell, `cell` in [0, n - 1)^3, of a cube with these corners, of
  // colors as `corner_color` gives them: a contiguous run, one per seed.
  struct Run {
    std::uint32_t first;
    std::uint32_t count;
  };
  Run stones_of(const Int3& cell, const CornerColors& corners) const;
  // The same for every cell of the cube, x fastest.
  void stones_of_cube(const CornerColors& corners, std::vector<Run>& runs) const;
  // The same for any cell of the infinite lattice, whose corners are colored by the set's seed.
  Run stones_at(const Int3& cell) const;

  // Largest extent of a stone beyond its own cell, in cells.
  double reach() const { return reach_; }

 private:
  friend class TileSetCodec;
  TileSet() = default;
  Run run_at(const rocks::CellLayout& layout, const Int3& cell, const CornerColors& corners) const;
  // Fills in where each cell's stones will be.
  std::vector<rocks::StoneKey> list_stones(const rocks::SeedTable& seeds);
  // Takes the stones made; of equal ones only the first is.
  void adopt(std::span<rocks::MadeStone> made, std::span<const rocks::StoneKey> keys,
             std::span<const std::uint32_t> first_equal);

  TileParams params_;
  std::uint64_t seed_ = 0;
  std::vector<Stone> stones_;
  std::vector<std::uint32_t> run_first_;  // per (cell, colors it depends on), one past the end last
  std::vector<std::uint32_t> cell_runs_;  // per cell, first entry of `run_first_`
  double reach_ = 0;
  TileStats stats_;
};

// Color of the corner of the infinite cube lattice at `corner`, in [0, colors): the same along z
// for columns, and 0 for a periodic set.
std::uint8_t corner_color(const TileParams& params, std::uint64_t seed, const Int3& corner);
CornerColors corner_colors(const TileParams& params, std::uint64_t seed, const Int3& cube);

}  // namespace talus
