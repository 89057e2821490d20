// Ground as columns of layers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/vec.h"
#include "talus/terrain/ledger.h"
#include "talus/terrain/material.h"

namespace talus {

// A height as an integer number of vertical steps.
using Steps = std::int32_t;
constexpr Steps kStepsMax = (1 << 26) - 1;  // 67 km at a step of 1 mm; the least is -kStepsMax

// A material and where it ends. It begins where the layer below ends, the lowest at the floor.
class Layer {
 public:
  Layer() = default;
  Layer(Material material, Steps top)
      : bits_(static_cast<std::uint32_t>(top) << 5 | static_cast<std::uint32_t>(material)) {}

  Material material() const { return static_cast<Material>(bits_ & 31u); }
  Steps top() const { return static_cast<Steps>(bits_) >> 5; }
  bool operator==(const Layer&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

// Where columns stand: nx x ny square cells of the plan from the south-west corner at (origin_x,
// origin_y), and how finely heights are counted.
struct TerrainGrid {
  int nx = 1;
  int ny = 1;
  double cell = 1;      // edge of a column, metres
  double step = 0.001;  // metres
  double origin_x = 0;  // metres
  double origin_y = 0;
  Steps floor = 0;  // below it is bedrock that is neither counted nor edited

  bool operator==(const TerrainGrid&) const = default;
};

// Columns [x_begin, x_end) x [y_begin, y_end).
struct ColumnArea {
  int x_begin = 0;
  int y_begin = 0;
  int x_end = 0;
  int y_end = 0;
};

// One column, unpacked for editing.
class ColumnEditor {
 public:
  // Bottom up: tops rise strictly from above the floor, neighbors differ, the last is not air.
  std::span<const Layer> layers() const { return layers_; }

  // What lies between two heights becomes one material, and is booked. What is below the floor
  // stays. Throws `Error` (usage) for a height beyond +-kStepsMax.
  void replace(Steps bottom, Steps top, Material material);

 private:
  friend class LayeredTerrain;
  void load(std::span<const Layer> layers) { layers_.assign(layers.begin(), layers.end()); }

  Steps floor_ = 0;
  std::vector<Layer> layers_;
  std::vector<Layer> scratch_;
  Booking booking_;
};

// A grid of columns; each is a run of layers over endless bedrock, under endless air
// ([Peytavie2009a] §3.2). Beyond the border is air. Columns are packed tile by tile without a
// pointer or an allocation of their own: 4 bytes a layer and 2 a column, besides a constant for
// each tile. Copies share tiles until one is edited. Safe for concurrent reading.
class LayeredTerrain {
 public:
  static constexpr int kTileColumns = 64;  // along x and y

  // All columns empty: bedrock to the floor, air above. Throws `Error` (usage) for sizes below 1 or
  // lengths that are not positive.
  explicit LayeredTerrain(const TerrainGrid& grid);

  const TerrainGrid& grid() const { return grid_; }

  // See `ColumnEditor::layers`. Valid until the column's tile is edited.
  std::span<const Layer> column(int x, int y) const;

  // Of the step [z, z + 1) of a column; any x, y, z.
  Material material(int x, int y, Steps z) const;
  // At a point in metres.
  Material material(const Vec3& p) const;

  // Calls `change(x, y, column)` for each column of the area within the grid, tiles in parallel,
  // and packs anew the tiles in which a column changed. Returns what was booked. If `change` throws
  // or the job is cancelled, the terrain is as before.
  using Change = std::function<void(int x, int y, ColumnEditor& column)>;
  Booking edit(const ColumnArea& area, const Change& change, Job* job = nullptr);
  Booking edit(const Change& change, Job* job = nullptr);

  // Thickness of each material over all columns, in steps; open air is not counted.
  MaterialSteps volume() const;

  std::size_t column_count() const;
  std::size_t layer_count() const;
  std::size_t bytes() const;  // everything included; shared tiles count in full

  bool operator==(const LayeredTerrain& other) const;

  // Heights in metres <-> steps: the nearest step to a height.
  double height_of(Steps z) const { return z * grid_.step; }
  Steps nearest_step(double height) const;

 private:
  struct Tile;
  TerrainGrid grid_;
  int tiles_x_ = 0;
  std::vector<std::shared_ptr<const Tile>> tiles_;
};

}  // namespace talus
