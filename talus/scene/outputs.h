// Where results go, found out before the long work starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "talus/base/job.h"
#include "talus/scene/build.h"

namespace talus {

// Throws `Error` (job) unless a file can be made in that folder.
void check_writable_folder(const std::filesystem::path& folder);

// Throws `Error` (job) unless `file` can be made or replaced: its folder is there and writable, and
// it is no folder itself.
void check_writable_file(const std::filesystem::path& file);

// A folder for results: made with those above it if missing, and checked to be writable. One that
// was made here and got no file is removed again, so that a job that fails leaves nothing.
class OutputFolder {
 public:
  // Throws `Error` (job).
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // innermost first
};

// Writes the files that the recipe's output asks for into an existing folder; returns them. Each is
// replaced as a whole or left as it was. Warns if there are more stones than its target opens as
// objects. Throws `Error` (job).
std::vector<std::filesystem::path> write_scene(const BuildResult& result,
                                               const std::filesystem::path& folder,
                                               Job* job = nullptr);

// Writes text as a whole or not at all. Throws `Error` (job).
void write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace talus
