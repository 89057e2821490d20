// Promise: the built-in scene, complete from its recipe to scene.glb and preview.png, with its
// tiles in the cache and nothing else, in under 8 s.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "bench/measure.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

// A folder for one benchmark's files.
class Workplace {
 public:
  explicit Workplace(const std::string& name)
      : path_(fs::temp_directory_path() /
              ("talus_bench_" + name + "_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  bool build(const std::string& options) const {
    const std::string command = "TALUS_CACHE_DIR='" + (path_ / "cache").string() + "' '" +
                                TALUS_TOOL + "' build --quiet -o '" + (path_ / "out").string() +
                                "' " + options + " > '" + (path_ / "log").string() + "' 2>&1";
    return std::system(command.c_str()) == 0;
  }

  // Every stage but the tiles has to be made anew.
  void forget_all_but_tiles() const {
    for (const auto& entry : fs::directory_iterator(path_ / "cache"))
      if (entry.path().extension() != ".tiles") fs::remove(entry.path());
  }

 private:
  fs::path path_;
};

void build_scene(benchmark::State& state, const std::string& name, const std::string& options,
                 double seconds) {
  const Workplace workplace(name);
  if (!workplace.build(options)) return state.SkipWithError("the tool fails");
  workplace.forget_all_but_tiles();
  const bench::Bound bound(state, seconds);
  for (auto _ : state) {
    if (!workplace.build(options)) return state.SkipWithError("the tool fails");
    state.PauseTiming();
    workplace.forget_all_but_tiles();
    state.ResumeTiming();
  }
}

void ravine(benchmark::State& state) { build_scene(state, "ravine", "", 8); }
void ravine_small(benchmark::State& state) {
  build_scene(state, "ravine_small", "--set terrain.cell=2 --no-preview", 8);
}
BENCHMARK(ravine)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(ravine_small)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace talus
