// A file that appears complete or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

// Writes beside `path` and renames into place on `commit`. Without a commit, for example because an
// exception passes, nothing remains and an older file at `path` is untouched. Every function throws
// `Error` (job) with the path and the system's reason when the system refuses: no space, a missing
// or unwritable folder, a path that is a folder or a device.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // The bytes of one trivially copyable value.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void write_value(const T& value) { write(&value, sizeof value); }

  // Bytes written so far.
  std::uint64_t size() const { return size_; }

  // Makes the file durable and visible at `path`. Call once, last.
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path path_;
  std::string part_;  // name while unfinished; empty once renamed
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;
  std::uint64_t size_ = 0;
};

}  // namespace talus
