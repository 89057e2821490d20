// The command-line tool as a child process.
#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace talus {

struct RunResult {
  int status = -1;  // as the shell counts: 128 + signal if one ended it
  std::string out;
  std::string error;
};

struct RunParams {
  // Called in the child before the program starts, for limits.
  std::function<void()> prepare = {};
  // Called in the parent with the child's id while it runs.
  std::function<void(pid_t)> meanwhile = {};
};

// Runs any program; the first word is looked up on the path.
RunResult run_program(const std::vector<std::string>& words, const RunParams& params = {});

// A working folder, with a cache of its own, to run the tool in.
class Workplace {
 public:
  Workplace();

  // `talus <arguments>`.
  RunResult talus(std::vector<std::string> arguments, const RunParams& params = {}) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  // Names of all files below the folder, the cache left out, sorted.
  std::vector<std::string> files() const;
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;

 private:
  TemporaryFolder folder_;
};

// Coarse tiles in a small shape, done in a fraction of a second.
extern const std::string kSmallRecipe;

}  // namespace talus
