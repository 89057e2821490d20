#include "talus/tools/noise_terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/parallel.h"
#include "talus/field/gradient_noise.h"

namespace talus {
namespace {

constexpr int kWarpOctaves = 3;

// Steps of that height, each rising over its last part only.
double terraced(double height, double step, double sharpness) {
  if (step <= 0) return height;
  const double level = std::floor(height / step);
  const double t = height / step - level;
  const double rise = std::clamp((t - sharpness) / std::max(1 - sharpness, 0.02), 0.0, 1.0);
  return step * (level + rise * rise * (3 - 2 * rise));
}

}  // namespace

HeightGrid noise_heights(int nx, int ny, double cell, const NoiseTerrainParams& params,
                         std::uint64_t seed, Job* job) {
  validate(params);
  const GradientNoise noise(seed);
  // Any other seeds would do.
  const GradientNoise shift_x(seed + 1), shift_y(seed + 2);
  const double warp_size = params.warp_size > 0 ? params.warp_size : params.feature_size;
  const FractalParams fractal_params{
      .octaves = params.octaves, .gain = params.gain, .ridged = params.ridged};
  const FractalParams warp_params{.octaves = kWarpOctaves};

  HeightGrid grid{.nx = nx, .ny = ny, .cell = cell};
  grid.heights.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  parallel_for(static_cast<std::size_t>(ny), [&](std::size_t row) {
    check_cancelled(job);
    const int y = static_cast<int>(row);
    for (int x = 0; x < nx; ++x) {
      const Vec2 place = cell * Vec2(x + 0.5, y + 0.5);
      Vec2 p = place;
      if (params.warp > 0)
        p += params.warp * Vec2(fractal(shift_x, place / warp_size, warp_params),
                                fractal(shift_y, place / warp_size, warp_params));
      const double rise = params.relief * fractal(noise, p / params.feature_size, fractal_params) +
                          glm::dot(params.grade, place);
      grid.heights[grid.index(x, y)] = static_cast<float>(
          params.height + terraced(rise, params.terrace, params.terrace_sharpness));
    }
  });
  return grid;
}

}  // namespace talus
