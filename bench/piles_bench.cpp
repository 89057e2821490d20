// Promises: a million stones a second and core in shapes; 100 000 stones in a mesh of 80 000
// triangles in half a second, the mesh made a support included.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bench/lump.h"
#include "bench/measure.h"
#include "talus/base/parallel.h"
#include "talus/field/mesh_support.h"
#include "talus/field/shape.h"
#include "talus/piles/pile.h"

namespace talus {
namespace {

using bench::Bound;
using bench::lump;

std::shared_ptr<const TileSet> tiles() {
  static const auto set = std::make_shared<const TileSet>(TileSet::make({}, 1));
  return set;
}

void pile_in_mesh(benchmark::State& state, TriangleMesh mesh, double share, bool open) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  if (open)
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.positions[t.x].z < -1.5f; });
  const auto set = tiles();
  const Bound bound(state, 0.5);
  for (auto _ : state) {
    const MeshSupport support(mesh);
    const Pile pile = fill(support, set, {.stone_size = {share, RelativeLength::Unit::fraction}});
    state.counters["stones"] = static_cast<double>(pile.stats.instances);
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
}

// Stones of 10 cm in a ball, by their number.
void pile_ball(benchmark::State& state, PileParams params) {
  const ThreadLimit limit(1);
  const auto set = tiles();
  const auto count = static_cast<double>(state.range(0));
  const double radius = 0.1 * std::cbrt(count * 3 / (4 * std::numbers::pi));
  const ShapeSupport ball(Sphere{.radius = radius});
  params.stone_size = {0.1};
  const Bound bound(state, count * 1e-6);
  for (auto _ : state) {
    const Pile pile = fill(ball, set, params);
    state.counters["stones"] = static_cast<double>(pile.stats.instances);
    state.counters["bytes_per_stone"] =
        static_cast<double>(pile.stones.bytes()) / static_cast<double>(pile.stats.instances);
  }
}

// Many millions, region by region: what is kept of each is its count.
void pile_stream(benchmark::State& state) {
  const auto set = tiles();
  const auto count = static_cast<double>(state.range(0));
  const double edge = 0.1 * std::sqrt(count / 10);
  const ShapeSupport bed(Box{.size = {edge, edge, 1}});
  const Bound bound(state, count * 1e-6);
  constexpr std::uint64_t kCubesAtOnce = 20'000;
  for (auto _ : state) {
    const PileFiller filler(bed, set, {.stone_size = {0.1}});
    std::uint64_t stones = 0, bytes = 0;
    for (const CubeBox& part : split(filler.cubes(), kCubesAtOnce)) {
      const Pile pile = filler.fill(part);
      stones += pile.stats.instances;
      bytes = std::max(bytes, pile.stones.bytes());
    }
    state.counters["stones"] = static_cast<double>(stones);
    state.counters["MB_at_once"] = static_cast<double>(bytes) / 1e6;
  }
}
BENCHMARK(pile_stream)->Arg(100'000'000)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

void pile_ten_million(benchmark::State& state) {
  const auto set = tiles();
  const ShapeSupport box(Box{.size = Vec3(0.1 * std::cbrt(1e7))});
  const Bound bound(state, 10);
  for (auto _ : state) {
    const Pile pile = fill(box, set, {.stone_size = {0.1}});
    state.counters["stones"] = static_cast<double>(pile.stats.instances);
    state.counters["bytes_per_stone"] =
        static_cast<double>(pile.stones.bytes()) / static_cast<double>(pile.stats.instances);
  }
}
BENCHMARK(pile_ten_million)->UseRealTime()->Unit(benchmark::kSecond);

// A bed two stones deep, nearly all of which straddle its surface.
void pile_bed(benchmark::State& state) {
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  const auto set = tiles();
  const ShapeSupport bed(Box{.size = {20, 20, 0.25}, .rounding = 0.02});
  const Bound bound(state, 0.1);
  for (auto _ : state) {
    const Pile pile = fill(bed, set, {.stone_size = {0.1}});
    state.counters["stones"] = static_cast<double>(pile.stats.instances);
  }
}

void pile_ball(benchmark::State& state) { pile_ball(state, {}); }
void pile_shell(benchmark::State& state) { pile_ball(state, {.surface_only = true}); }
BENCHMARK(pile_ball)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(pile_bed)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(pile_shell)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

void pile_closed_80k(benchmark::State& state) { pile_in_mesh(state, lump(142), 0.0109, false); }
void pile_open_72k(benchmark::State& state) { pile_in_mesh(state, lump(142), 0.0119, true); }
void pile_small(benchmark::State& state) { pile_in_mesh(state, lump(16), 0.1, false); }
BENCHMARK(pile_closed_80k)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(pile_open_72k)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(pile_small)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
