#include "cli/program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace talus {

const std::string kSmallRecipe =
    "seed = 5\n"
    "[[operation]]\n"
    "type = \"pile\"\n"
    "support = { shape = \"sphere\", radius = 2 }\n"
    "stone_size = \"20%\"\n"
    "tiles = { n = 5, voxels_per_edge = 20 }\n";

RunResult run_program(const std::vector<std::string>& words, const RunParams& params) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  int out[2], error[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(error, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe can be made");
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    dup2(error[1], STDERR_FILENO);
    if (params.prepare) params.prepare();
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(out[1]);
  close(error[1]);
  if (params.meanwhile) params.meanwhile(child);

  // Read both pipes as they fill, until the child has closed them.
  RunResult result;
  struct Stream {
    int descriptor;
    std::string* text;
  };
  std::vector<Stream> streams = {{out[0], &result.out}, {error[0], &result.error}};
  while (!streams.empty()) {
    std::vector<pollfd> polled;
    for (const Stream& stream : streams) polled.push_back({stream.descriptor, POLLIN, 0});
    poll(polled.data(), polled.size(), -1);
    for (std::size_t i = streams.size(); i-- > 0;) {
      if (polled[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t count = read(streams[i].descriptor, buffer, sizeof buffer);
      if (count > 0) {
        streams[i].text->append(buffer, static_cast<std::size_t>(count));
      } else {
        close(streams[i].descriptor);
        streams.erase(streams.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

Workplace::Workplace() = default;

RunResult Workplace::talus(std::vector<std::string> arguments, const RunParams& params) const {
  arguments.insert(arguments.begin(), TALUS_PROGRAM);
  RunParams here = params;
  here.prepare = [&] {
    if (chdir(folder_.path().c_str()) != 0) _exit(126);
    setenv("TALUS_CACHE_DIR", (folder_ / "cache").c_str(), 1);
    if (params.prepare) params.prepare();
  };
  return run_program(arguments, here);
}

std::vector<std::string> Workplace::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
    const std::string name = entry.path().lexically_relative(folder_.path()).string();
    if (!name.starts_with("cache")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void Workplace::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace talus
