// What a mesh of a stone costs by itself; for scale beside others' ways, see rocks_vtk_bench.cpp.
#include <benchmark/benchmark.h>

#include "bench/stone_fields.h"
#include "talus/mesh/polygonize.h"

namespace talus {
namespace {

void polygonize_stones(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  std::vector<std::vector<float>> fields;
  for (int i = 0; i < 64; ++i)
    fields.push_back(bench::stone_field(side, static_cast<std::uint64_t>(i)));
  PolygonizeScratch scratch;
  std::size_t triangles = 0;
  for (auto _ : state)
    for (const std::vector<float>& field : fields) {
      const TriangleMesh mesh = polygonize({Int3(side), field}, scratch);
      triangles += mesh.triangles.size();
      benchmark::DoNotOptimize(mesh.positions.data());
    }
  state.counters["triangles_per_s"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
}
BENCHMARK(polygonize_stones)->Arg(16)->Arg(30)->ArgName("side")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
