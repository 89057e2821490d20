// Binary files of the cache, believed only if not a bit of them has changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace talus {

// Collects values as they lie in memory, little-endian as every machine of the baseline.
class SealedWriter {
 public:
  explicit SealedWriter(std::string_view magic) : bytes_(magic) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add_all(std::span<const T> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }

  // Writes all that was added and its digest. Throws `Error` (job).
  void save(const std::filesystem::path& path) const;

 private:
  std::string bytes_;
};

// Gives the values back in the order in which they were added. Every function throws `Error`
// (input) naming the file if it is missing, damaged, or has no such value left.
class SealedReader {
 public:
  SealedReader(const std::filesystem::path& path, std::string_view magic);
  SealedReader(const SealedReader&) = delete;  // it reads from within itself
  SealedReader& operator=(const SealedReader&) = delete;

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void read(T& value) { copy(&value, sizeof value); }
  void read(bool& value) {
    std::uint8_t byte = 0;
    read(byte);
    require(byte <= 1);
    value = byte == 1;
  }
  // As many as there are left.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> read_rest() {
    require(rest_.size() % sizeof(T) == 0);
    std::vector<T> values(rest_.size() / sizeof(T));
    copy(values.data(), rest_.size());
    return values;
  }

  bool at_end() const { return rest_.empty(); }

  // Throws unless the condition holds.
  void require(bool condition) const;

 private:
  void copy(void* to, std::size_t size);

  std::string name_;
  std::string file_;
  std::string_view rest_;
};

}  // namespace talus
