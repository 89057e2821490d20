// One bit for each sample of a grid.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace talus {

// Bit i is set if flags[i] is 1. A flag is a byte of 0 or 1.
class GridBits {
 public:
  void assign(std::span<const std::uint8_t> flags) {
    words_.assign((flags.size() + 63) / 64, 0);
    std::size_t i = 0;
    for (; i + 8 <= flags.size(); i += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, &flags[i], 8);
      // The product's highest byte collects the lowest bits of the bytes.
      words_[i / 64] |= (eight * 0x0102040810204080u >> 56) << (i % 64);
    }
    for (; i < flags.size(); ++i) words_[i / 64] |= std::uint64_t{flags[i]} << (i % 64);
  }

  std::size_t count() const {
    std::size_t n = 0;
    for (const std::uint64_t word : words_) n += static_cast<std::size_t>(std::popcount(word));
    return n;
  }

  // Calls `use(i)` for every set bit, in order.
  void for_each(auto&& use) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
        use(64 * w + static_cast<std::size_t>(std::countr_zero(left)));
  }

  // Calls `use(begin, end)` for every longest run of set bits, in order.
  void for_each_run(auto&& use) const {
    std::size_t begin = 0;
    bool in_run = false;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      // Bits that differ from the one before them.
      std::uint64_t changes = words_[w] ^ (words_[w] << 1 | in_run);
      for (; changes != 0; changes &= changes - 1) {
        const std::size_t i = 64 * w + static_cast<std::size_t>(std::countr_zero(changes));
        if (in_run) use(begin, i);
        begin = i;
        in_run = !in_run;
      }
    }
    if (in_run) use(begin, 64 * words_.size());
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace talus
