// How fast supports answer: for points one by one (row:0) and for rows of 64 (row:1).
#include <bit>

#include "bench/lump.h"
#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/field/formula.h"
#include "talus/field/mesh_support.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

constexpr int kRow = 64;

// Starts of rows in places by chance; steps as of voxels.
void ask(benchmark::State& state, const Support& support) {
  const Box3 box = support.bounds();
  const Vec3 step(box.longest_side() / 1000, 0, 0);
  const bool rows = state.range(0) == 1;
  std::uint64_t inside = 0;
  std::int64_t row = 0;
  for (auto _ : state) {
    Vec3 first;
    for (int axis = 0; axis < 3; ++axis)
      first[axis] = uniform(hash(1, Purpose::texture, row, axis), box.min[axis], box.max[axis]);
    const std::uint64_t bits = rows ? support.contains_row(first, step, kRow)
                                    : support.Support::contains_row(first, step, kRow);
    inside += static_cast<std::uint64_t>(std::popcount(bits));
    ++row;
  }
  benchmark::DoNotOptimize(inside);
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(row * kRow), benchmark::Counter::kIsRate);
}

// A wall with a door, the garden's gravel, and a mesh of 80 000 triangles.
void formula(benchmark::State& state) {
  ask(state, FormulaSupport("hypot(x, y) < 2.5 * sqrt(max(0, 1 - (z / 4) ^ 2)) and not hypot(x, y) "
                            "< 1.8 and not (y < 0 and abs(x) < 0.5 and z < 1.8)",
                            {Vec3(-2.5, -2.5, 0), Vec3(2.5, 2.5, 4)}));
}
void raked(benchmark::State& state) {
  ask(state, ShapeSupport(Raked{.rings = {{-1, 0, 1}, {1, 0.5, 0.8}}}));
}
void shapes(benchmark::State& state) {
  ask(state, ShapeSupport(Combination{
                 Combination::Rule::join,
                 0.1,
                 {Sphere{{0, 0, 0}, 1}, Capsule{{0, 0, 0}, {1, 1, 2}, 0.6, 0.2}, Box{}}}));
}
void mesh_80k(benchmark::State& state) { ask(state, MeshSupport(bench::lump(142))); }
void mesh_small(benchmark::State& state) { ask(state, MeshSupport(bench::lump(16))); }

BENCHMARK(formula)->Arg(0)->Arg(1)->ArgName("row");
BENCHMARK(raked)->Arg(0)->Arg(1)->ArgName("row");
BENCHMARK(shapes)->Arg(0)->Arg(1)->ArgName("row");
BENCHMARK(mesh_80k)->Arg(0)->Arg(1)->ArgName("row");
BENCHMARK(mesh_small)->Arg(0)->Arg(1)->ArgName("row");

}  // namespace
}  // namespace talus
