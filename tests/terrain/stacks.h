// Small random terrains with caves, and the plainest model of one.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "talus/base/hash.h"
#include "talus/terrain/layered_terrain.h"

namespace talus::test {

// The k-th random number below `count` for a seed.
inline int pick(std::uint64_t seed, int k, int count) {
  return static_cast<int>(hash(seed, Purpose::texture, k) % static_cast<std::uint64_t>(count));
}

// Columns of up to `layers` random layers, air among them, each up to `thickness` steps thick.
inline LayeredTerrain random_stacks(std::uint64_t seed, const TerrainGrid& grid, int layers = 9,
                                    int thickness = 9) {
  LayeredTerrain terrain(grid);
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const std::uint64_t place = hash(seed, Purpose::texture, x, y);
    Steps bottom = grid.floor;
    const int count = pick(place, 0, layers + 1);
    for (int i = 0; i < count; ++i) {
      const Steps top = bottom + 1 + pick(place, 2 * i + 1, thickness);
      column.replace(bottom, top, static_cast<Material>(pick(place, 2 * i + 2, kMaterialCount)));
      bottom = top;
    }
  });
  return terrain;
}

// One entry for each step of each column, from the floor up.
struct Voxels {
  TerrainGrid grid;
  Steps height;
  std::vector<Material> materials;

  Voxels(const TerrainGrid& g, Steps h)
      : grid(g),
        height(h),
        materials(static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(g.ny) *
                      static_cast<std::size_t>(h),
                  Material::air) {}

  Material& at(int x, int y, Steps z) {
    return materials[(static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.nx) +
                      static_cast<std::size_t>(x)) *
                         static_cast<std::size_t>(height) +
                     static_cast<std::size_t>(z - grid.floor)];
  }
  MaterialSteps volume() const {
    MaterialSteps volume{};
    for (const Material m : materials)
      if (m != Material::air) ++volume[static_cast<std::size_t>(m)];
    return volume;
  }
};

inline MaterialSteps sum(MaterialSteps a, const MaterialSteps& b) {
  for (std::size_t m = 0; m < a.size(); ++m) a[m] += b[m];
  return a;
}

// What every terrain promises of its columns.
inline void expect_well_formed(const LayeredTerrain& terrain) {
  for (int y = 0; y < terrain.grid().ny; ++y)
    for (int x = 0; x < terrain.grid().nx; ++x) {
      Steps below = terrain.grid().floor;
      Material material_below = Material::air;
      bool first = true;
      for (const Layer& layer : terrain.column(x, y)) {
        ASSERT_GT(layer.top(), below) << x << ", " << y;
        ASSERT_TRUE(first || layer.material() != material_below) << x << ", " << y;
        below = layer.top();
        material_below = layer.material();
        first = false;
      }
      ASSERT_TRUE(first || material_below != Material::air) << x << ", " << y;
    }
}

}  // namespace talus::test
