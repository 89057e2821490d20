#include "talus/mesh/grid_rows.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace talus {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

std::size_t count_bits(std::span<const std::uint64_t> words) {
  std::size_t count = 0;
  for (const std::uint64_t word : words) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

// The runs of set bits in `row` that hold one of `some`, which are among them.
std::uint64_t runs_with(std::uint64_t some, std::uint64_t row) {
  if (some == 0) return 0;
  const bool one_run = (row & (row + (row & (~row + 1)))) == 0;
  if (one_run) return row;
  std::uint64_t up = some, down = some, above = row, below = row;
  for (int shift = 1; shift < 64; shift *= 2) {
    up |= above & up << shift;
    above &= above << shift;
    down |= below & down >> shift;
    below &= below >> shift;
  }
  return up | down;
}

}  // namespace

void GridRows::assign(const Int3& size, const GridBits& inside) {
  size_ = size;
  words_per_row_ = static_cast<std::size_t>((size.x + 63) / 64);
  rows_.clear();
  std::size_t i = 0;
  for (int row = 0; row < size.y * size.z; ++row)
    for (int left = size.x; left > 0; left -= 64) {
      const int count = std::min(left, 64);
      rows_.push_back(inside.word_at(i) & kAll >> (64 - count));
      i += static_cast<std::size_t>(count);
    }
}

std::size_t GridRows::keep_largest_piece() {
  left_ = rows_;
  const std::size_t total = count_bits(rows_);
  std::size_t remaining = total, most = 0;
  for (std::size_t w = 0; remaining > most; ++w)
    while (left_[w] != 0) {
      flood(w);
      if (piece_ == rows_) return 0;
      const std::size_t count = count_bits(piece_);
      remaining -= count;
      for (std::size_t i = w; i < left_.size(); ++i) left_[i] &= ~piece_[i];
      if (count <= most) continue;
      most = count;
      largest_.swap(piece_);
    }
  if (most > 0) rows_.swap(largest_);
  return total - most;
}

// Rows take what touches them in those around, forward and backward in turns.
void GridRows::flood(std::size_t first) {
  const std::size_t dy = words_per_row_, dz = word(0, 1);
  piece_.assign(left_.size(), 0);
  piece_[first] = left_[first] & (~left_[first] + 1);
  const auto grow = [&](std::size_t w) {
    if (left_[w] == 0) return false;
    const std::uint64_t before = piece_[w];
    const std::uint64_t around = before | piece_[w - 1] >> 63 | piece_[w + 1] << 63 |
                                 piece_[w - dy] | piece_[w + dy] | piece_[w - dz] | piece_[w + dz];
    piece_[w] = runs_with(around & left_[w], left_[w]);
    return piece_[w] != before;
  };
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t w = first; w < left_.size(); ++w) grown |= grow(w);
    if (piece_ == left_) return;
    for (std::size_t w = left_.size(); w-- > first;) grown |= grow(w);
  }
}

GridRows::Box GridRows::box() const {
  Int3 low(std::numeric_limits<int>::max()), high(-1);
  for (int z = 0; z < size_.z; ++z)
    for (int y = 0; y < size_.y; ++y)
      for (std::size_t k = 0; k < words_per_row_; ++k) {
        const std::uint64_t bits = rows_[word(y, z) + k];
        if (bits == 0) continue;
        const int x = static_cast<int>(64 * k);
        low = glm::min(low, Int3(x + std::countr_zero(bits), y, z));
        high = glm::max(high, Int3(x + 63 - std::countl_zero(bits), y, z));
      }
  return high.x < 0 ? Box{Int3(0), Int3(0)} : Box{low, high - low + 1};
}

std::vector<std::uint64_t> GridRows::packed(const Box& box) const {
  const std::size_t bits = static_cast<std::size_t>(box.size.x) *
                           static_cast<std::size_t>(box.size.y) *
                           static_cast<std::size_t>(box.size.z);
  std::vector<std::uint64_t> result((bits + 63) / 64);
  std::size_t to = 0;
  for (int z = 0; z < box.size.z; ++z)
    for (int y = 0; y < box.size.y; ++y)
      for (int x = 0; x < box.size.x; x += 64) {
        const int count = std::min(box.size.x - x, 64);
        const auto from = static_cast<std::size_t>(box.min.x + x);
        const std::uint64_t* const row = &rows_[word(box.min.y + y, box.min.z + z)];
        std::uint64_t chunk = row[from / 64] >> (from % 64);
        if (from / 64 + 1 < words_per_row_) chunk |= row[from / 64 + 1] << 1 << (63 - from % 64);
        chunk &= kAll >> (64 - count);
        result[to / 64] |= chunk << (to % 64);
        if (to % 64 + static_cast<std::size_t>(count) > 64)
          result[to / 64 + 1] |= chunk >> (64 - to % 64);
        to += static_cast<std::size_t>(count);
      }
  return result;
}

}  // namespace talus
