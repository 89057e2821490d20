#include "talus/scene/cache.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace talus {

namespace fs = std::filesystem;

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
  for (fs::directory_iterator it(*folder_, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const Entry entry{it->path(), it->last_write_time(gone), gone ? 0 : it->file_size(gone)};
    if (gone || !it->is_regular_file(gone)) continue;
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
