// One bit for each sample of a grid.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace talus {

class GridBits {
 public:
  // Bit i is set if flags[i] is 1. A flag is a byte of 0 or 1.
  void assign(std::span<const std::uint8_t> flags) {
    make(flags.size(), [&](std::size_t i) {
      std::array<std::uint8_t, 64> last{};
      const std::uint8_t* from = &flags[i];
      if (flags.size() - i < last.size()) {
        std::copy(flags.begin() + static_cast<std::ptrdiff_t>(i), flags.end(), last.begin());
        from = last.data();
      }
      std::uint64_t word = 0;
      for (unsigned k = 0; k < 64; k += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, from + k, sizeof eight);
        // The product's highest byte collects the lowest bits of the bytes.
        word |= (eight * 0x0102040810204080u >> 56) << k;
      }
      return word;
    });
  }

  // `word(i)` gives bits i to i + 63; those from `size` > 0 on are dropped.
  void make(std::size_t size, auto&& word) {
    words_.resize((size + 63) / 64 + 1);
    for (std::size_t w = 0; w + 1 < words_.size(); ++w) words_[w] = word(64 * w);
    words_[words_.size() - 2] &= ~std::uint64_t{0} >> (63 - (size - 1) % 64);
    words_.back() = 0;
  }

  // Bits i to i + 63; zeros beyond the last.
  std::uint64_t word_at(std::size_t i) const {
    if (i / 64 + 1 >= words_.size()) return 0;
    return words_[i / 64] >> (i % 64) | words_[i / 64 + 1] << 1 << (63 - i % 64);
  }

  std::size_t count() const {
    std::size_t n = 0;
    for (const std::uint64_t word : words_) n += static_cast<std::size_t>(std::popcount(word));
    return n;
  }

  // The set bits' numbers, in order.
  void list(std::vector<std::int32_t>& numbers) const {
    numbers.resize(count());
    std::int32_t* next = numbers.data();
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
        *next++ = static_cast<std::int32_t>(64 * w) + std::countr_zero(left);
  }

 private:
  std::vector<std::uint64_t> words_;  // the last is 0
};

}  // namespace talus
