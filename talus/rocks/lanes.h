// A few floats or integers side by side, for one instruction.
#pragma once

#include <cstdint>
#include <cstring>

namespace talus::rocks {

inline constexpr int kLanes = 8;
using Floats [[gnu::vector_size(4 * kLanes)]] = float;
using Indices [[gnu::vector_size(4 * kLanes)]] = std::int32_t;

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

}  // namespace talus::rocks
