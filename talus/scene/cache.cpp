#include "talus/scene/cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

namespace talus {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kKeyDigits = 32;
constexpr std::array<std::string_view, 3> kKinds = {".pile", ".terrain", ".tiles"};
// A file that was not written to for so long is no longer being written.
constexpr auto kStaleAge = std::chrono::hours(24);

bool is_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

// What follows the digits of an entry's name; empty if a file is none of ours.
std::string_view entry_kind(std::string_view name) {
  const std::size_t digits =
      static_cast<std::size_t>(std::find_if_not(name.begin(), name.end(), is_digit) - name.begin());
  return digits == kKeyDigits ? name.substr(digits) : std::string_view();
}

bool is_entry(std::string_view name) {
  return std::find(kKinds.begin(), kKinds.end(), entry_kind(name)) != kKinds.end();
}

// An entry as `AtomicFile` names it before it is complete: "<entry>.<number>.part".
bool is_part(std::string_view name) {
  const std::string_view kind = entry_kind(name);
  return kind.ends_with(".part") && std::any_of(kKinds.begin(), kKinds.end(), [&](auto entry) {
           return kind.starts_with(entry) && kind.substr(entry.size()).starts_with('.');
         });
}

}  // namespace

fs::path default_cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  if (const fs::path own = variable("TALUS_CACHE_DIR"); !own.empty()) return own;
  if (const fs::path base = variable("XDG_CACHE_HOME"); !base.empty()) return base / "talus";
  if (const fs::path home = variable("HOME"); !home.empty()) return home / ".cache" / "talus";
  return {};
}

bool Cache::touch(const fs::path& path) const {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);
  return true;
}

void Cache::prepare() const {
  std::error_code error;
  fs::create_directories(*folder_, error);
  if (error) throw job_error(folder_->string() + ": " + error.message());
}

void Cache::trim(const fs::path& newest) const {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t bytes;
  };
  // Another process may delete entries meanwhile: what cannot be read is no longer there.
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator it(*folder_, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code gone;
    if ((!is_entry(name) && !is_part(name)) || !it->is_regular_file(gone)) continue;
    const Entry entry{it->path(), it->last_write_time(gone), gone ? 0 : it->file_size(gone)};
    if (gone) continue;
    if (is_part(name)) {
      if (now - entry.used > kStaleAge) fs::remove(entry.path, gone);
      continue;
    }
    total += entry.bytes;
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= bytes_max_) break;
    if (entry.path == newest || !fs::remove(entry.path, error)) continue;
    total -= entry.bytes;
  }
}

}  // namespace talus
