// Chance as a function of place, and fingerprints of data.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace talus {

// What a random value is for: two purposes at one place are independent.
enum class Purpose : std::uint64_t {
  corner_color = 1,
  seed_count,
  seed_position,
  seed_frame,
  seed_size,
  seed_axes,
  weathering,
  stone_color,
  texture,
  gradient_noise,
  cover_patches,
  contact_discard,
  pile_density,
  scatter_sites,
  scatter_plot,
  scatter_density,
};

// Mixes 64 bits so that every output bit depends on every input bit (Stafford's variant 13 of the
// murmur3 finalizer).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// One coordinate more for a hash: hash(s, p, x, y) is extend(hash(s, p, x), y). Values that share
// their first coordinates share that work.
constexpr std::uint64_t extend(std::uint64_t h, std::int64_t coordinate) {
  return mix_bits(h + 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(coordinate));
}

// A random 64-bit value for (seed, purpose, integer coordinates). The only source of chance.
template <std::integral... Coordinates>
constexpr std::uint64_t hash(std::uint64_t seed, Purpose purpose, Coordinates... coordinates) {
  std::uint64_t h = mix_bits(seed ^ (static_cast<std::uint64_t>(purpose) << 56));
  ((h = extend(h, static_cast<std::int64_t>(coordinates))), ...);
  return h;
}

// Uniform in [0, 1), all 53 bits of a double used.
constexpr double uniform(std::uint64_t random) {
  return static_cast<double>(random >> 11) * 0x1p-53;
}
constexpr double uniform(std::uint64_t random, double low, double high) {
  return low + (high - low) * uniform(random);
}

// 128-bit fingerprint of a sequence of values (XXH3); same bytes, same digest, on any machine of
// one endianness.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  void add_bytes(const void* data, std::size_t size);
  void add(std::string_view text);
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T value) { add_bytes(&value, sizeof value); }
  // Size, then the elements' bytes; element types must have no padding.
  template <class T, std::size_t N>
  requires std::is_trivially_copyable_v<T>
  void add(std::span<T, N> values) {
    add(static_cast<std::uint64_t>(values.size()));
    add_bytes(values.data(), values.size_bytes());
  }

  // Of everything added so far: its two halves, and as 32 lower-case hexadecimal digits.
  std::array<std::uint64_t, 2> words() const;
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus
