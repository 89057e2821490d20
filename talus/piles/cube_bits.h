// One bit for each stone of some cubes of a tiling.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/piles/tiling.h"

namespace talus {

// Cubes of which some bit is set, in order of place, each with the same number of words: some 20
// bytes for the 64 stones of a default cube.
class CubeBits {
 public:
  explicit CubeBits(std::size_t words_per_cube = 1) : words_per_cube_(words_per_cube) {}

  std::size_t words_per_cube() const { return words_per_cube_; }
  std::size_t size() const { return cubes_.size(); }
  const Int3& cube(std::size_t i) const { return cubes_[i]; }
  std::span<const std::uint64_t> words(std::size_t i) const {
    return {words_.data() + i * words_per_cube_, words_per_cube_};
  }
  std::optional<std::size_t> find(const Int3& cube) const;
  // First cube that is not before `cube`.
  std::size_t lower_bound(const Int3& cube) const;

  // Adds a cube behind all others; one without a bit is left out.
  void append(const Int3& cube, std::span<const std::uint64_t> words);
  // Replaces what is known of a cube.
  void put(const Int3& cube, std::span<const std::uint64_t> words);
  void shrink_to_fit();

  std::uint64_t bit_count() const;
  std::uint64_t bytes() const;
  bool operator==(const CubeBits&) const = default;

 private:
  std::size_t words_per_cube_;
  std::vector<Int3> cubes_;
  std::vector<std::uint64_t> words_;
};

// Calls `visit(number)` for every bit that is set, in order.
void for_each_bit(std::span<const std::uint64_t> words, auto&& visit) {
  for (std::size_t w = 0; w < words.size(); ++w)
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
      visit(static_cast<std::uint32_t>(64 * w) +
            static_cast<std::uint32_t>(std::countr_zero(left)));
}

inline bool test_bit(std::span<const std::uint64_t> words, std::uint32_t number) {
  return words[number / 64] >> (number % 64) & 1;
}
inline void set_bit(std::span<std::uint64_t> words, std::uint32_t number, bool value = true) {
  const std::uint64_t bit = std::uint64_t{1} << (number % 64);
  words[number / 64] = value ? words[number / 64] | bit : words[number / 64] & ~bit;
}

}  // namespace talus
