// A whole file in memory.
#pragma once

#include <filesystem>
#include <string>

namespace talus {

// The file's bytes. Throws `Error` (input) with the path and the reason: missing, a folder,
// unreadable.
std::string read_file(const std::filesystem::path& path);

// Throws like `read_file`, for files that another library reads.
void check_readable_file(const std::filesystem::path& path);

}  // namespace talus
