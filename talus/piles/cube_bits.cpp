#include "talus/piles/cube_bits.h"

#include <algorithm>

namespace talus {
namespace {

bool any(std::span<const std::uint64_t> words) {
  return std::any_of(words.begin(), words.end(), [](std::uint64_t word) { return word != 0; });
}

}  // namespace

std::size_t CubeBits::lower_bound(const Int3& cube) const {
  return static_cast<std::size_t>(std::lower_bound(cubes_.begin(), cubes_.end(), cube, is_before) -
                                  cubes_.begin());
}

std::optional<std::size_t> CubeBits::find(const Int3& cube) const {
  const std::size_t i = lower_bound(cube);
  if (i == cubes_.size() || cubes_[i] != cube) return std::nullopt;
  return i;
}

void CubeBits::append(const Int3& cube, std::span<const std::uint64_t> words) {
  if (!any(words)) return;
  cubes_.push_back(cube);
  words_.insert(words_.end(), words.begin(), words.end());
}

void CubeBits::put(const Int3& cube, std::span<const std::uint64_t> words) {
  const std::size_t i = lower_bound(cube);
  const auto word = words_.begin() + static_cast<std::ptrdiff_t>(i * words_per_cube_);
  const auto next = static_cast<std::ptrdiff_t>(words_per_cube_);
  const bool is_known = i < cubes_.size() && cubes_[i] == cube;
  if (is_known && any(words)) {
    std::copy(words.begin(), words.end(), word);
  } else if (is_known) {
    cubes_.erase(cubes_.begin() + static_cast<std::ptrdiff_t>(i));
    words_.erase(word, word + next);
  } else if (any(words)) {
    cubes_.insert(cubes_.begin() + static_cast<std::ptrdiff_t>(i), cube);
    words_.insert(word, words.begin(), words.end());
  }
}

void CubeBits::shrink_to_fit() {
  cubes_.shrink_to_fit();
  words_.shrink_to_fit();
}

std::uint64_t CubeBits::bit_count() const {
  std::uint64_t count = 0;
  for (const std::uint64_t word : words_) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

std::uint64_t CubeBits::bytes() const {
  return cubes_.capacity() * sizeof(Int3) + words_.capacity() * sizeof(std::uint64_t);
}

}  // namespace talus
