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

// Columns [x_begin, x_end) x [y_begin, y_end).
struct ColumnArea {
  int x_begin = 0;
  int y_begin = 0;
  int x_end = 0;
  int y_end = 0;

  bool empty() const { return x_begin >= x_end || y_begin >= y_end; }
  bool contains(int x, int y) const {
    return x >= x_begin && x < x_end && y >= y_begin && y < y_end;
  }
  bool operator==(const ColumnArea&) const = default;
};
ColumnArea intersection(const ColumnArea& a, const ColumnArea& b);

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

  // Column or step that holds a coordinate in metres; of what is out of reach the nearest number
  // that is too: -1 or nx, -1 or ny, -kStepsMax - 1 or kStepsMax + 1.
  int column_x(double x) const;
  int column_y(double y) const;
  Steps step_at(double z) const;

  // Where a column's axis stands.
  Vec2 center(int x, int y) const {
    return {origin_x + (x + 0.5) * cell, origin_y + (y + 0.5) * cell};
  }
  // The columns that a rectangle of the plan meets.
  ColumnArea columns_within(const Vec2& min, const Vec2& max) const;

  bool operator==(const TerrainGrid&) const = default;
};

// Puts a layer on a column that grows upward: one of the material below thickens it, one whose top
// does not rise is nothing.
void stack(std::vector<Layer>& column, Steps floor, Material material, Steps top);

// One column, unpacked for editing.
class ColumnEditor {
 public:
  // Bottom up: tops rise strictly from above the floor, neighbors differ, the last is not air.
  std::span<const Layer> layers() const { return layers_; }
  Steps floor() const { return floor_; }

  // What lies between two heights becomes one material, and is booked; nothing if `top` is not
  // above `bottom`. What is below the floor stays. Throws `Error` (usage) for a height beyond
  // +-kStepsMax.
  void replace(Steps bottom, Steps top, Material material);

  // The column's matter in another arrangement, apart from the conversions, which are booked: each
  // material's thickness must differ from before by what they tell. `layers` obeys the rules of
  // `layers()` and is not part of this editor.
  void rearrange(std::span<const Layer> layers, std::span<const Conversion> conversions = {});

 private:
  friend class LayeredTerrain;
  explicit ColumnEditor(Steps floor) : floor_(floor) {}
  void load(std::span<const Layer> layers) { layers_.assign(layers.begin(), layers.end()); }

  Steps floor_;
  std::vector<Layer> layers_;
  std::vector<Layer> scratch_;
  Booking booking_;
};

// A grid of columns; each is a run of layers over endless bedrock, under endless air
// ([Peytavie2009a] §3.2). Beyond the border is air. Columns are packed tile by tile without a
// pointer or an allocation of their own: 4 bytes a layer and 2 a column (4 in a tile of more than
// 65 535 layers), besides a constant for each tile. Copies share tiles until one is edited. Safe
// for concurrent reading.
class LayeredTerrain {
 public:
  static constexpr int kTileColumns = 64;  // along x and y

  // All columns empty: bedrock to the floor, air above. Throws `Error` (usage) for fewer than 1 or
  // more than 2^30 columns, or a length that is not positive and finite.
  explicit LayeredTerrain(const TerrainGrid& grid);

  const TerrainGrid& grid() const { return grid_; }

  // See `ColumnEditor::layers`. Of a column within the grid; valid until its tile is edited.
  std::span<const Layer> column(int x, int y) const;

  // Of the step [z, z + 1) of a column; any x, y, z.
  Material material(int x, int y, Steps z) const;
  // At a point in metres.
  Material material(const Vec3& p) const;

  // Calls `change(x, y, column)` for each column of the area within the grid and packs anew the
  // tiles in which a column changed. Tiles are worked on in parallel; the columns of one, one after
  // the other, row by row. Until all are done the terrain stays as it was: `change` may read it,
  // and if it throws or the job is cancelled nothing happened. Returns what was booked.
  using Change = std::function<void(int x, int y, ColumnEditor& column)>;
  Booking edit(const ColumnArea& area, const Change& change, Job* job = nullptr);
  Booking edit(const Change& change, Job* job = nullptr);

  // Thickness of each material over all columns.
  MaterialSteps volume() const;

  std::size_t column_count() const;
  std::size_t layer_count() const;
  // Everything included: pointers, reference counts, the allocator's headers. Shared tiles count in
  // full.
  std::size_t bytes() const;

  bool operator==(const LayeredTerrain& other) const;

  // Heights in metres <-> steps: the nearest step to a height. Throws `Error` (usage) if it is not
  // finite or beyond +-kStepsMax.
  double height_of(Steps z) const { return z * grid_.step; }
  Steps nearest_step(double height) const;
  // Or `most` if that is less, however high.
  Steps nearest_step(double height, Steps most) const;

 private:
  struct Tile;
  ColumnArea tile_area(std::size_t tile) const;
  std::shared_ptr<const Tile> edited(std::size_t tile, const ColumnArea& part, const Change& change,
                                     Booking& booking) const;

  TerrainGrid grid_;
  int tiles_x_ = 0;
  std::vector<std::shared_ptr<const Tile>> tiles_;
};

}  // namespace talus
