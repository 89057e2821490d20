// A made landscape of many layers, for tests and benchmarks.
#pragma once

#include <algorithm>
#include <vector>

#include "talus/field/gradient_noise.h"
#include "talus/terrain/layered_terrain.h"

namespace talus::test {

// The layers of column (x, y), bottom up: mountains with up to two levels of caves, sand, soil,
// rocks, water in the low parts and snow on the high ones. Columns are 1 m wide and reach up to
// 8000 steps of 5 cm.
inline void cave_scene_column(int x, int y, std::vector<Layer>& layers) {
  constexpr double kHeight = 8000;
  const auto noise = [&](std::uint64_t seed, double cells, int octaves) {
    return fractal(GradientNoise(seed), cells / 250 * Vec2(x, y), {.octaves = octaves});
  };
  const auto share = [](double s) { return static_cast<Steps>(s * kHeight); };
  layers.clear();

  // Bedrock up to its surface, opened where galleries swell.
  const Steps surface = share(0.48 + 0.24 * noise(1, 1, 8));
  Steps roof = 0;
  for (std::uint64_t level = 0; level < 2; ++level) {
    const double open = std::clamp(4 * (noise(10 + level, 2, 4) - 0.06), 0.0, 1.0);
    const double middle =
        0.13 + 0.19 * static_cast<double>(level) + 0.08 * noise(20 + level, 1.5, 4);
    const double half = 0.02 * open * (1 + 0.8 * noise(30 + level, 6, 3));
    const Steps floor = share(middle - half), top = share(middle + half);
    if (top <= floor || floor <= roof + 8 || top >= surface - share(0.02)) continue;
    stack(layers, 0, Material::bedrock, floor);
    stack(layers, 0, Material::air, top);
    roof = top;
  }
  stack(layers, 0, Material::bedrock, surface);

  // Deposits in patches, water up to one level.
  Steps top = surface;
  const auto deposit = [&](Material material, double amount) {
    if (amount > 0) top += share(amount);
    stack(layers, 0, material, top);
  };
  deposit(Material::sand, 0.08 * noise(40, 3, 4));
  deposit(Material::soil, 0.08 * noise(41, 4, 4));
  deposit(Material::rocks, 0.08 * noise(42, 5, 4) - 0.008);
  stack(layers, 0, Material::water, share(0.45));
  if (top > share(0.54)) deposit(Material::snow, 0.04 * noise(43, 3, 4));
}

inline LayeredTerrain cave_scene(int nx, int ny) {
  LayeredTerrain terrain({.nx = nx, .ny = ny, .cell = 1, .step = 0.05});
  terrain.edit([](int x, int y, ColumnEditor& column) {
    thread_local std::vector<Layer> layers;
    cave_scene_column(x, y, layers);
    Steps bottom = 0;
    for (const Layer& layer : layers) {
      column.replace(bottom, layer.top(), layer.material());
      bottom = layer.top();
    }
  });
  return terrain;
}

}  // namespace talus::test
