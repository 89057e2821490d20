// Files of a test's own, and what is thrown over them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "talus/base/error.h"
#include "temporary_folder.h"

namespace talus::test {

class Scratch {
 public:
  std::filesystem::path path(std::string_view name) const { return folder_.path() / name; }
  std::filesystem::path file(std::string_view name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  // Names in the folder, so that leftovers show.
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

 private:
  TemporaryFolder folder_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

// The kind and line of the `Error` that `call` throws; fails the test if it throws none.
struct Refusal {
  ErrorKind kind = ErrorKind::job;
  std::string line;
};
template <class Call>
Refusal refusal_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.kind(), error.what()};
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace talus::test
