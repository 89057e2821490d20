// The stones of one cube of a tiling, numbered.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/rocks/tile_set.h"

namespace talus::piles {

// Numbers count the stones of a cube's cells, x fastest, then by seed; empty stones have a number
// too. The tile set must outlive it.
class CubeStones {
 public:
  explicit CubeStones(const TileSet& tiles);

  // Turns to the cube at this place of the infinite lattice.
  void go_to(const Int3& cube);

  std::size_t cell_count() const { return runs_.size(); }
  // Of a cell, relative to the cube.
  Int3 cell_at(std::size_t cell) const {
    const int i = static_cast<int>(cell);
    return {i % period_, i / period_ % period_, i / (period_ * period_)};
  }
  std::size_t index_of(const Int3& cell) const {
    return static_cast<std::size_t>(cell.x + period_ * (cell.y + period_ * cell.z));
  }
  // A cell's stones in the tile set, and the number of the first of them; one cell past the end
  // too.
  const TileSet::Run& run(std::size_t cell) const { return runs_[cell]; }
  std::uint32_t first_number(std::size_t cell) const { return first_number_[cell]; }

  std::uint32_t stone_count() const { return first_number_.back(); }
  std::size_t cell_of(std::uint32_t number) const;
  // Index into the tile set.
  std::uint32_t stone(std::uint32_t number) const {
    const std::size_t cell = cell_of(number);
    return runs_[cell].first + (number - first_number_[cell]);
  }

 private:
  const TileSet& tiles_;
  int period_;
  bool one_each_ = false;  // every cell has one stone
  std::vector<TileSet::Run> runs_;
  std::vector<std::uint32_t> first_number_;
};

// Words of 64 bits that hold a bit for each stone of any cube.
std::size_t words_per_cube(const TileSet& tiles);

// The cube that a cell of the infinite lattice belongs to.
inline Int3 cube_of(const Int3& cell, int period) {
  return {floor_div(cell.x, period), floor_div(cell.y, period), floor_div(cell.z, period)};
}

}  // namespace talus::piles
