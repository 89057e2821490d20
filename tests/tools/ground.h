// Ground of bedrock alone.
#pragma once

#include <cmath>

#include "talus/terrain/layered_terrain.h"

namespace talus::test {

// Bedrock up to a height that a function of the column's place, from the grid's corner, tells.
inline LayeredTerrain ground(const TerrainGrid& grid, auto&& height) {
  LayeredTerrain terrain(grid);
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const double h = height((x + 0.5) * grid.cell, (y + 0.5) * grid.cell);
    column.replace(grid.floor, static_cast<Steps>(std::lround(h / grid.step)), Material::bedrock);
  });
  return terrain;
}

}  // namespace talus::test
