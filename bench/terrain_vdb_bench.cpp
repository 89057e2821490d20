// The landscape of terrain_bench.cpp in OpenVDB grids, which editors of volumes would use instead.
#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <array>
#include <memory>

#include "bench/terrain_scene.h"

namespace talus::bench {
namespace {

constexpr int kLeaf = 8;  // voxels along the edge of a leaf
constexpr int kLeafVoxels = kLeaf * kLeaf * kLeaf;

// One value a voxel; 0, the background, is air.
struct MaterialVoxels {
  using Grid = openvdb::Grid<openvdb::tree::Tree4<std::uint8_t, 5, 4, 3>::Type>;
  static std::uint8_t value(Material m) {
    return m == Material::air ? 0 : static_cast<std::uint8_t>(static_cast<int>(m) + 1);
  }
};
struct SolidVoxels {
  using Grid = openvdb::BoolGrid;
  static bool value(Material m) { return m != Material::air && m != Material::water; }
};

// Leaves where voxels differ, tiles of one value elsewhere.
template <class Voxels>
typename Voxels::Grid::Ptr make_grid(const LayeredTerrain& terrain) {
  using Grid = typename Voxels::Grid;
  using Leaf = typename Grid::TreeType::LeafNodeType;
  auto grid = Grid::create();
  const int nx = terrain.grid().nx, ny = terrain.grid().ny;
  Steps highest = 0;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) highest = std::max(highest, terrain.column(x, y).back().top());

  std::array<typename Grid::ValueType, kLeafVoxels> values;
  std::array<std::span<const Layer>, kLeaf * kLeaf> layers;  // not yet passed
  for (int x0 = 0; x0 < nx; x0 += kLeaf)
    for (int y0 = 0; y0 < ny; y0 += kLeaf) {
      for (int c = 0; c < kLeaf * kLeaf; ++c) {
        const int x = x0 + c / kLeaf, y = y0 + c % kLeaf;
        layers[static_cast<std::size_t>(c)] =
            x < nx && y < ny ? terrain.column(x, y) : std::span<const Layer>();
      }
      for (Steps z0 = 0; z0 < highest; z0 += kLeaf) {
        // In the order of a leaf's voxels: z fastest, then y.
        auto value = values.begin();
        for (std::span<const Layer>& column : layers)
          for (Steps z = z0; z < z0 + kLeaf; ++z) {
            while (!column.empty() && z >= column[0].top()) column = column.subspan(1);
            *value++ = column.empty() ? 0 : Voxels::value(column[0].material());
          }
        const openvdb::Coord corner(x0, y0, z0);
        if (std::all_of(values.begin(), values.end(), [&](auto v) { return v == values[0]; })) {
          if (values[0]) grid->tree().addTile(1, corner, values[0], true);
          continue;
        }
        auto leaf = std::make_unique<Leaf>(corner, 0, false);
        for (openvdb::Index i = 0; i < kLeafVoxels; ++i)
          if (values[i]) leaf->setValueOn(i, values[i]);
        grid->tree().addLeaf(leaf.release());
      }
    }
  openvdb::tools::prune(grid->tree());
  return grid;
}

template <class Voxels>
void vdb(benchmark::State& state, int nx, int ny) {
  openvdb::initialize();
  const LayeredTerrain& scene = cave_scene(nx, ny);
  for (auto _ : state) {
    const auto grid = make_grid<Voxels>(scene);
    const auto bytes = static_cast<double>(grid->memUsage());
    state.counters["MB"] = bytes / 1e6;
    state.counters["bytes_per_column"] = bytes / static_cast<double>(scene.column_count());
    state.counters["of_columns"] = bytes / static_cast<double>(scene.bytes());
  }
}

void vdb_materials(benchmark::State& state) { vdb<MaterialVoxels>(state, kSceneX, kSceneY); }
void vdb_solid(benchmark::State& state) { vdb<SolidVoxels>(state, kSceneX, kSceneY); }
void vdb_small(benchmark::State& state) { vdb<MaterialVoxels>(state, 100, 75); }
BENCHMARK(vdb_materials)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(vdb_solid)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(vdb_small)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus::bench
