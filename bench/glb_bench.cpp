// Promise: a million stones of the default tile set written as GLB and read back in under 3 s, the
// file at most 16 MB larger than its meshes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/io/glb_writer.h"
#include "talus/io/scene_reader.h"
#include "talus/rocks/tile_set.h"

namespace talus {
namespace {

using bench::Bound;

// `side`^3 stones, of a mesh by chance for each place, as a pile has them: all turned and scaled
// alike.
InstanceTable stones_of(const TileSet& tiles, int side) {
  constexpr float kCellSize = 0.3f;
  InstanceTable table;
  for (const Stone& stone : tiles.stones())
    if (stone.mesh) table.prototypes.push_back(stone.mesh);
  std::sort(table.prototypes.begin(), table.prototypes.end());
  table.prototypes.erase(std::unique(table.prototypes.begin(), table.prototypes.end()),
                         table.prototypes.end());
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const std::uint64_t chance = hash(1, Purpose::texture, x, y, z);
        table.instances.push_back(
            {.position = static_cast<double>(kCellSize) * Vec3(x, y, z),
             .scale = kCellSize,
             .prototype = static_cast<std::uint32_t>(chance % table.prototypes.size())});
      }
  std::stable_sort(table.instances.begin(), table.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; });
  return table;
}

// A file of the system's folder for such, removed at the end.
class ScratchFile {
 public:
  ScratchFile()
      : path_(std::filesystem::temp_directory_path() / fmt::format("talus_{}.glb", getpid())) {}
  ~ScratchFile() { std::filesystem::remove(path_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void write_and_read(benchmark::State& state, const TileSet& tiles, int side) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const InstanceTable stones = stones_of(tiles, side);
  InstanceTable one_each{.prototypes = stones.prototypes};
  for (std::uint32_t k = 0; k < stones.prototypes.size(); ++k)
    one_each.instances.push_back({.prototype = k});
  const ScratchFile file;
  // What its meshes take: the file of one stone of each, less what that says of places.
  const std::uint64_t meshes = write_glb(file.path(), {.stones = &one_each}).bytes;

  const Bound bound(state, 3.0);
  for (auto _ : state) {
    const GlbStats stats = write_glb(file.path(), {.stones = &stones});
    const auto read = read_scene(file.path());
    if (!read || read->stones.instances.size() != stones.instances.size())
      state.SkipWithError("other stones came back");
    state.counters["MB"] = static_cast<double>(stats.bytes) / 1e6;
    state.counters["beyond_meshes_MB"] = static_cast<double>(stats.bytes - meshes) / 1e6;
    state.counters["nodes"] = static_cast<double>(stats.nodes);
  }
  state.counters["stones"] = static_cast<double>(stones.instances.size());
  state.counters["meshes"] = static_cast<double>(stones.prototypes.size());
}

void glb_million(benchmark::State& state) {
  static const TileSet tiles = TileSet::make({}, 1);
  write_and_read(state, tiles, 100);
}
void glb_small(benchmark::State& state) {
  static const TileSet tiles = TileSet::make({.variety = Variety::periodic}, 1);
  write_and_read(state, tiles, 20);
}
BENCHMARK(glb_million)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(glb_small)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
