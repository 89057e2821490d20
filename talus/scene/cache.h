// Results of earlier runs, kept on disk by a hash of everything they depend on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "talus/base/error.h"
#include "talus/base/job.h"

namespace talus {

// $TALUS_CACHE_DIR, else $XDG_CACHE_HOME/talus, else ~/.cache/talus; empty if none is set.
std::filesystem::path default_cache_folder();

// A folder of files named by their keys: 32 hexadecimal digits, then ".tiles", ".pile" or
// ".terrain". Other files in it are neither counted nor deleted. A cache is never needed: what is
// missing, damaged or cannot be written is made again, at worst with a warning.
class Cache {
 public:
  // Once more than `bytes_max` are kept, the entries that were not used for longest go. Without a
  // folder nothing is kept.
  Cache(std::optional<std::filesystem::path> folder, std::uintmax_t bytes_max)
      : folder_(std::move(folder)), bytes_max_(bytes_max) {}

  // The entry of that key: `load(path)` if there is one, else `make()`, kept by `save(path, made)`.
  // A `load` that throws `Error` means a damaged entry. `hit` tells whether it was loaded.
  auto load_or_make(const std::string& key, auto&& load, auto&& make, auto&& save, bool& hit,
                    Job* job) -> decltype(make()) {
    hit = false;
    if (!folder_) return make();
    const std::filesystem::path path = *folder_ / key;
    if (touch(path)) {
      try {
        auto loaded = load(path);
        hit = true;
        return loaded;
      } catch (const Error&) {
        // Damaged: made again below.
      }
    }
    auto made = make();
    try {
      prepare();
      save(path, made);
      trim(path);
    } catch (const Error& error) {
      warn(job, std::string("the result is not kept for the next run: ") + error.what());
    }
    return made;
  }

 private:
  // Whether the entry exists; marks it as used now.
  bool touch(const std::filesystem::path& path) const;
  // Makes the folder. Throws `Error` (job).
  void prepare() const;
  // Deletes the oldest entries beyond the bound, and what killed runs left unfinished; never
  // `newest`.
  void trim(const std::filesystem::path& newest) const;

  std::optional<std::filesystem::path> folder_;
  std::uintmax_t bytes_max_;
};

}  // namespace talus
