// A few floats or integers side by side, for one instruction.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace talus {

inline constexpr int kLanes = 8;
using Floats [[gnu::vector_size(4 * kLanes)]] = float;
using Indices [[gnu::vector_size(4 * kLanes)]] = std::int32_t;
using Words [[gnu::vector_size(4 * kLanes)]] = std::uint32_t;
inline constexpr int kDoubleLanes = 4;
using Doubles [[gnu::vector_size(8 * kDoubleLanes)]] = double;

template <class Lanes>
Lanes load(const void* from) {
  Lanes result;
  std::memcpy(&result, from, sizeof result);
  return result;
}

template <class Lanes>
void store(const Lanes& lanes, void* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

// values[indices[k]] for each lane.
inline Floats gather(const float* values, const std::int32_t* indices) {
  Floats result;
  for (std::size_t k = 0; k < kLanes; ++k) result[k] = values[indices[k]];
  return result;
}

inline Floats sqrt(const Floats& lanes) {
  Floats result;
  for (std::size_t k = 0; k < kLanes; ++k) result[k] = std::sqrt(lanes[k]);
  return result;
}
inline Doubles sqrt(const Doubles& lanes) {
  Doubles result{};
  for (std::size_t k = 0; k < kDoubleLanes; ++k) result[k] = std::sqrt(lanes[k]);
  return result;
}

inline Doubles floor(const Doubles& lanes) {
  Doubles result{};
  for (std::size_t k = 0; k < kDoubleLanes; ++k) result[k] = std::floor(lanes[k]);
  return result;
}

// Bit k says whether the comparison that gave the mask holds for lane k.
template <class Mask>
std::uint64_t bits_of(const Mask& mask) {
  std::uint64_t bits = 0;
  for (int k = 0; k < kDoubleLanes; ++k) bits |= static_cast<std::uint64_t>(mask[k] & (1 << k));
  return bits;
}

}  // namespace talus
