// Promise: a tile set of n = 5 at 10 voxels a cell, 7 382 stones, in under 2 s on one thread.
#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/rocks/stone_maker.h"

namespace talus {
namespace {

using bench::Bound;

std::string digest(const TileSet& tiles) {
  Digest d;
  for (const Stone& stone : tiles.stones())
    if (stone.mesh) d.add(std::span(stone.mesh->positions));
  return d.hex();
}

void make_tiles(benchmark::State& state, const TileParams& params, double bound_s) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  std::string hash;
  {
    const Bound bound(state, bound_s);
    for (auto _ : state) {
      const TileSet tiles = TileSet::make(params, 1);
      benchmark::DoNotOptimize(tiles.stones().data());
      if (hash.empty()) {
        state.PauseTiming();
        hash = digest(tiles);
        state.counters["stones"] = static_cast<double>(tiles.stones().size());
        state.counters["triangles"] = static_cast<double>(tiles.stats().triangles);
        state.ResumeTiming();
      }
    }
  }
  state.SetLabel(hash);
}

void tiles_n5(benchmark::State& state) { make_tiles(state, {}, 2.0); }
BENCHMARK(tiles_n5)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);

void tiles_small(benchmark::State& state) { make_tiles(state, {.voxels_per_edge = 20}, 2.0); }
BENCHMARK(tiles_small)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

// Phases of n = 5 on one thread.
void phase_labels(benchmark::State& state) {
  const ThreadLimit limit(1);
  for (auto _ : state) {
    const rocks::BlockTable blocks({}, 1, nullptr);
    benchmark::DoNotOptimize(&blocks);
  }
  state.counters["ns_per_voxel"] =
      benchmark::Counter(318 * 20 * 20 * 20 * 1e-9, benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}
BENCHMARK(phase_labels)->Unit(benchmark::kMillisecond);

void phase_stones(benchmark::State& state) {
  const TileParams params;
  const rocks::BlockTable blocks(params, 1, nullptr);
  rocks::StoneMaker maker(params, blocks);
  std::uint32_t code = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(maker.make({Int3(2), code++ % 256, 0}).stone.volume);
}
BENCHMARK(phase_stones)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace talus
