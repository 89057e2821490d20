// Promise: the ground mesh of 1 000 x 750 columns of 3.9 layers, one vertex per column spacing,
// with normals and shares, in under 1.5 s on 2 threads.
#include <benchmark/benchmark.h>

#include <span>
#include <vector>

#include "bench/measure.h"
#include "bench/terrain_scene.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/terrain/field_sampler.h"
#include "talus/terrain/ground_mesh.h"

namespace talus::bench {
namespace {

template <class T>
double megabytes(const std::vector<T>& values) {
  return static_cast<double>(values.capacity() * sizeof(T)) / 1e6;
}

void mesh_ground(benchmark::State& state, int nx, int ny, const GroundMeshParams& params) {
  const LayeredTerrain& scene = cave_scene(nx, ny);
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  GroundMesh ground;
  {
    const Bound bound(state, 1.5);
    for (auto _ : state) {
      ground = {};
      ground = make_ground_mesh(scene, params);
    }
  }
  const TriangleMesh& mesh = ground.mesh;
  const auto triangles = static_cast<double>(mesh.triangles.size());
  const auto cells = static_cast<double>(ground.surface_cells);
  state.counters["triangles"] = triangles;
  state.counters["triangles_per_s"] =
      benchmark::Counter(triangles, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["samples_per_cell"] = static_cast<double>(ground.field_samples) / cells;
  state.counters["deviation_mean_m"] = ground.deviation_mean;
  state.counters["mesh_MB"] = megabytes(mesh.positions) + megabytes(mesh.normals) +
                              megabytes(mesh.shares) + megabytes(mesh.triangles);
  state.counters["scratch_MB"] = static_cast<double>(ground.scratch_bytes) / 1e6;
  Digest digest;
  digest.add(std::span(mesh.positions));
  digest.add(std::span(mesh.normals));
  digest.add(std::span(mesh.shares));
  digest.add(std::span(mesh.triangles));
  state.SetLabel(digest.hex());
}

void ground_mesh(benchmark::State& state) { mesh_ground(state, kSceneX, kSceneY, {.skirt = 0}); }
void ground_mesh_closed(benchmark::State& state) {
  mesh_ground(state, kSceneX, kSceneY, {.skirt = 10});
}
// The part that an edit of one tile makes anew.
void ground_mesh_of_tile(benchmark::State& state) {
  mesh_ground(state, kSceneX, kSceneY, {.skirt = 0, .area = ColumnArea{448, 320, 512, 384}});
}
void ground_mesh_small(benchmark::State& state) { mesh_ground(state, 96, 64, {.skirt = 10}); }
BENCHMARK(ground_mesh)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ground_mesh_closed)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ground_mesh_of_tile)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(ground_mesh_small)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// Values at places near the tops of columns, far from each other.
void field_value(benchmark::State& state) {
  const LayeredTerrain& scene = cave_scene(kSceneX, kSceneY);
  const TerrainField field(scene);
  FieldSampler sampler(field);
  std::vector<Vec3> places;
  for (int i = 0; i < 1 << 14; ++i) {
    const int x = static_cast<int>(hash(1, Purpose::texture, i, 0) % kSceneX);
    const int y = static_cast<int>(hash(1, Purpose::texture, i, 1) % kSceneY);
    places.emplace_back(x + 0.3, y + 0.6, scene.column(x, y).back().top());
  }
  double sum = 0;
  for (std::size_t i = 0; auto _ : state) sum += sampler.value(places[i++ % places.size()]);
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(field_value)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace talus::bench
