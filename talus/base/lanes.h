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
  Doubles result;
  for (std::size_t k = 0; k < kDoubleLanes; ++k) result[k] = std::sqrt(lanes[k]);
  return result;
}

}  // namespace talus
