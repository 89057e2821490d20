// Promises: tile sets at 10 voxels a cell, from seeds to full-detail meshes, within these seconds
// on one thread and on two. A tile set of n = 5 takes less than 300 MB.
#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/rocks/deviation.h"
#include "talus/rocks/equal_stones.h"
#include "talus/rocks/labels.h"
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

struct Seconds {
  double on_one, on_two;
};

void make_tiles(benchmark::State& state, const TileParams& params, const Seconds& seconds) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const double bound_s = state.range(0) == 1 ? seconds.on_one : seconds.on_two;
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
        state.counters["meshes"] = static_cast<double>(tiles.stats().distinct_meshes);
        state.counters["triangles"] = static_cast<double>(tiles.stats().triangles);
        state.ResumeTiming();
      }
    }
  }
  state.SetLabel(hash);
}

void tiles_small(benchmark::State& state) {
  make_tiles(state, {.voxels_per_edge = 20}, {0.15, 0.1});
}
BENCHMARK(tiles_small)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

void tiles_n5(benchmark::State& state) { make_tiles(state, {}, {0.30, 0.18}); }
BENCHMARK(tiles_n5)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);

void tiles_n5_s20(benchmark::State& state) {
  make_tiles(state, {.seeds_min = 1, .seeds_max = 20}, {1.0, 0.6});
}
BENCHMARK(tiles_n5_s20)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

void tiles_n6(benchmark::State& state) { make_tiles(state, {.n = 6}, {0.8, 0.45}); }
BENCHMARK(tiles_n6)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

void tiles_n7(benchmark::State& state) { make_tiles(state, {.n = 7}, {1.3, 0.75}); }
BENCHMARK(tiles_n7)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);

void tiles_n9(benchmark::State& state) { make_tiles(state, {.n = 9}, {9, 5}); }
BENCHMARK(tiles_n9)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

// Phases of n = 5 on one thread. What they leave of the whole is memory and the tile set's tables.

// The stones of every eighth coloring, to keep the phases short.
template <class Use>
std::int64_t for_each_eighth_stone(const rocks::CellLayout& layout, Use&& use) {
  std::int64_t stones = 0;
  for (std::size_t c = 0; c < layout.cell_count(); ++c) {
    const Int3 cell = layout.cell_at(c);
    const std::uint32_t codes = rocks::code_count(layout.stone_corners(cell), layout.colors);
    for (std::uint32_t code = 0; code < codes; code += 8, ++stones)
      use(rocks::StoneKey{cell, code, 0});
  }
  return stones;
}

// Reads as the time for one item.
benchmark::Counter time_each(double items) {
  return {items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

constexpr int kCandidates = 27;
constexpr std::int64_t kBlockVoxels = 318 * 20 * 20 * 20;

// Labels and patches.
void phase_blocks(benchmark::State& state) {
  const ThreadLimit limit(1);
  for (auto _ : state) {
    const rocks::BlockTable blocks({}, 1, nullptr);
    benchmark::DoNotOptimize(&blocks);
  }
  state.counters["voxel"] = time_each(kBlockVoxels);
}
BENCHMARK(phase_blocks)->Unit(benchmark::kMillisecond);

void phase_labels(benchmark::State& state) {
  const rocks::BlockTable table({}, 1, nullptr);
  for (auto _ : state)
    for (const rocks::Block& known : table.blocks()) {
      rocks::Block block{.min = known.min,
                         .size = known.size,
                         .first_cell = known.first_cell,
                         .cells = known.cells,
                         .candidates = known.candidates,
                         .cell_first = known.cell_first};
      rocks::label(block);
      benchmark::DoNotOptimize(block.owners.data());
    }
  state.counters["voxel"] = time_each(kBlockVoxels);
}
BENCHMARK(phase_labels)->Unit(benchmark::kMillisecond);

// The certified bound, which needs the blocks only.
void phase_deviation(benchmark::State& state) {
  const ThreadLimit limit(1);
  const rocks::BlockTable table({}, 1, nullptr);
  for (auto _ : state) benchmark::DoNotOptimize(rocks::deviation_bound(table));
}
BENCHMARK(phase_deviation)->Unit(benchmark::kMillisecond);

// What labels cost at least: one quadratic form along a row, and its minimum, for each candidate.
void floor_of_labels(benchmark::State& state) {
  constexpr int kRow = 24;
  float centers[kRow], nearest[kRow];
  for (int x = 0; x < kRow; ++x) centers[x] = static_cast<float>(x) + 0.5f;
  float xx = 1.1f, linear = -3, constant = 2;
  for (auto _ : state) {
    std::fill(std::begin(nearest), std::end(nearest), 1e9f);
    for (int c = 0; c < kCandidates; ++c) {
      benchmark::DoNotOptimize(xx);
      benchmark::DoNotOptimize(linear);
      benchmark::DoNotOptimize(constant);
      for (int x = 0; x < kRow; ++x) {
        const float d = (xx * centers[x] + linear) * centers[x] + constant;
        nearest[x] = d < nearest[x] ? d : nearest[x];
      }
    }
    benchmark::DoNotOptimize(nearest);
  }
  state.counters["voxel"] = time_each(kRow);
}
BENCHMARK(floor_of_labels);

void phase_contacts(benchmark::State& state) {
  const rocks::BlockTable blocks({}, 1, nullptr);
  rocks::StoneGrid grid;
  rocks::ContactFinder finder;
  std::int64_t stones = 0;
  for (auto _ : state)
    stones = for_each_eighth_stone(blocks.layout(), [&](const rocks::StoneKey& key) {
      grid.gather(blocks, key);
      benchmark::DoNotOptimize(finder.find(grid).data());
    });
  state.counters["stone"] = time_each(static_cast<double>(stones));
}
BENCHMARK(phase_contacts)->Unit(benchmark::kMillisecond);

void phase_weathering(benchmark::State& state) {
  const TileParams params;
  const rocks::BlockTable blocks(params, 1, nullptr);
  rocks::Weathering weathering(params, blocks.layout().voxels_per_cell);
  // A few stones with their contacts, gathered beforehand.
  std::vector<rocks::StoneGrid> grids;
  std::vector<std::vector<rocks::Contact>> contacts;
  rocks::ContactFinder finder;
  for (std::uint32_t code = 0; code < 256; code += 4) {
    grids.emplace_back().gather(blocks, {Int3(2), code, 0});
    contacts.push_back(finder.find(grids.back()));
  }
  for (auto _ : state)
    for (std::size_t i = 0; i < grids.size(); ++i)
      benchmark::DoNotOptimize(weathering.wear(grids[i], contacts[i]).data());
  state.counters["stone"] = time_each(static_cast<double>(grids.size()));
}
BENCHMARK(phase_weathering)->Unit(benchmark::kMillisecond);

void phase_equal_stones(benchmark::State& state) {
  const ThreadLimit limit(1);
  const rocks::BlockTable blocks({}, 1, nullptr);
  std::vector<rocks::StoneKey> stones;
  for_each_eighth_stone(blocks.layout(), [&](const rocks::StoneKey& k) { stones.push_back(k); });
  for (auto _ : state) benchmark::DoNotOptimize(rocks::find_equal_stones(blocks, stones).data());
}
BENCHMARK(phase_equal_stones)->Unit(benchmark::kMillisecond);

// Everything from blocks to meshes.
void phase_stones(benchmark::State& state) {
  const TileParams params;
  const rocks::BlockTable blocks(params, 1, nullptr);
  rocks::StoneMaker maker(params, blocks);
  std::int64_t stones = 0;
  for (auto _ : state)
    stones = for_each_eighth_stone(blocks.layout(), [&](const rocks::StoneKey& key) {
      benchmark::DoNotOptimize(maker.make(key).stone.volume);
    });
  state.counters["stone"] = time_each(static_cast<double>(stones));
}
BENCHMARK(phase_stones)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
