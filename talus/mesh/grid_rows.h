// The samples of a grid that are inside, by rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/vec.h"
#include "talus/mesh/grid_bits.h"

namespace talus {

// One bit for each sample; every row along x begins a word. Samples on the border of the grid are
// outside. Working memory is reused from grid to grid.
class GridRows {
 public:
  // Bit x + size.x (y + size.y z) of `inside` is sample (x, y, z).
  void assign(const Int3& size, const GridBits& inside);

  bool inside(const Int3& sample) const {
    return rows_[word(sample.y, sample.z) + static_cast<std::size_t>(sample.x / 64)] >>
               (sample.x % 64) &
           1;
  }

  // Takes all away but the largest piece connected across faces, of equals the first along x, y, z;
  // returns how many samples it took.
  std::size_t keep_largest_piece();

  // The least box around those inside.
  struct Box {
    Int3 min, size;  // size 0 if there are none
  };
  Box box() const;

  // Those of a box in order, a bit each, packed.
  std::vector<std::uint64_t> packed(const Box& box) const;

 private:
  std::size_t word(int y, int z) const {
    return words_per_row_ * (static_cast<std::size_t>(y) +
                             static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(z));
  }
  // Sets `piece_` to the piece of `left_` that holds its first sample, which word `first` holds.
  void flood(std::size_t first);

  Int3 size_{0};
  std::size_t words_per_row_ = 0;
  std::vector<std::uint64_t> rows_;
  std::vector<std::uint64_t> left_, piece_, largest_;
};

}  // namespace talus
