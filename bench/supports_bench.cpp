// How fast supports answer: for 64 points one by one (how:0) and as a block (how:1), for 64 boxes
// around them as a block (how:2).
#include <bit>

#include "bench/lump.h"
#include "bench/measure.h"
#include "talus/base/hash.h"
#include "talus/field/formula.h"
#include "talus/field/mesh_support.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

// Blocks in places by chance; steps as of voxels.
void ask(benchmark::State& state, const Support& support) {
  const Box3 box = support.bounds();
  const double step = box.longest_side() / 1000;
  std::uint64_t inside = 0;
  std::int64_t count = 0;
  for (auto _ : state) {
    PointBlock block{.step = {Vec3(step, 0, 0), Vec3(0, step, 0), Vec3(0, 0, step)}};
    for (int axis = 0; axis < 3; ++axis)
      block.first[axis] =
          uniform(hash(1, Purpose::texture, count, axis), box.min[axis], box.max[axis]);
    const std::uint64_t bits = state.range(0) == 0 ? support.Support::contains_block(block)
                               : state.range(0) == 1
                                   ? support.contains_block(block)
                                   : support.classify_block(block, Vec3(0.5 * step)).inside;
    inside += static_cast<std::uint64_t>(std::popcount(bits));
    ++count;
  }
  benchmark::DoNotOptimize(inside);
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(count * kBlockPoints), benchmark::Counter::kIsRate);
}

// A wall with a door, the garden's gravel, and a mesh of 80 000 triangles.
void formula(benchmark::State& state) {
  ask(state,
      FormulaSupport("hypot(x, y) < 2.5 * sqrt(max(0, 1 - (z / 4.1) ^ 2.4)) and not hypot(x, y) "
                     "< 1.8 * sqrt(max(0, 1 - (z / 3.45) ^ 2.4)) and not (y < 0 and abs(x) < 0.5 - "
                     "0.4 * max(0, z - 1.3))",
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

BENCHMARK(formula)->DenseRange(0, 2)->ArgName("how");
BENCHMARK(raked)->DenseRange(0, 2)->ArgName("how");
BENCHMARK(shapes)->DenseRange(0, 2)->ArgName("how");
BENCHMARK(mesh_80k)->DenseRange(0, 2)->ArgName("how");
BENCHMARK(mesh_small)->DenseRange(0, 2)->ArgName("how");

}  // namespace
}  // namespace talus
