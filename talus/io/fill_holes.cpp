#include "talus/io/fill_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "talus/base/parallel.h"

namespace talus {
namespace {

constexpr float kRelaxation = 1.9f;  // fits holes some 60 cells wide; larger ones begin well
constexpr int kSweepsMax = 300;
constexpr float kTolerance = 1e-4f;      // metres; a sweep that moves nothing further is the last
constexpr std::size_t kBlock = 1 << 14;  // cells of one task

// Half the resolution: each cell the mean of those known among its four.
HeightGrid halved(const HeightGrid& fine) {
  HeightGrid coarse{.nx = (fine.nx + 1) / 2, .ny = (fine.ny + 1) / 2};
  coarse.heights.resize(static_cast<std::size_t>(coarse.nx) * static_cast<std::size_t>(coarse.ny));
  parallel_for(static_cast<std::size_t>(coarse.ny), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < coarse.nx; ++x) {
      float sum = 0;
      int known = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, fine.ny); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, fine.nx); ++u)
          if (const float height = fine.heights[fine.index(u, v)]; !std::isnan(height)) {
            sum += height;
            ++known;
          }
      // Without a known one it becomes NaN.
      coarse.heights[coarse.index(x, y)] = sum / static_cast<float>(known);
    }
  });
  return coarse;
}

// Bilinear, at the center of a cell of the grid with twice the resolution.
float interpolated(const HeightGrid& coarse, int fine_x, int fine_y) {
  const auto split = [](int fine, int count, int& low, int& high) {
    low = std::clamp((fine - 1) >> 1, 0, count - 1);
    high = std::min((fine + 1) >> 1, count - 1);
    return fine % 2 == 0 ? 0.75f : 0.25f;  // weight of the higher one
  };
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  const float u = split(fine_x, coarse.nx, x0, x1), v = split(fine_y, coarse.ny, y0, y1);
  const auto at = [&](int x, int y) { return coarse.heights[coarse.index(x, y)]; };
  return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x1, y0)) +
         v * ((1 - u) * at(x0, y1) + u * at(x1, y1));
}

// Overrelaxation of the given cells, those of even x + y first, then the others.
void relax(HeightGrid& grid, const std::vector<std::size_t>& even,
           const std::vector<std::size_t>& odd, Job* job) {
  const auto nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  const auto neighbor_mean = [&](std::size_t i) {
    const std::size_t x = i % nx, y = i / nx;
    float sum = 0;
    int count = 0;
    const auto add = [&](bool there, std::size_t j) {
      if (!there) return;
      sum += grid.heights[j];
      ++count;
    };
    add(x > 0, i - 1);
    add(x + 1 < nx, i + 1);
    add(y > 0, i - nx);
    add(y + 1 < ny, i + nx);
    return sum / static_cast<float>(count);
  };
  std::vector<float> moved(std::max(even.size(), odd.size()) / kBlock + 1);
  for (int sweep = 0; sweep < kSweepsMax; ++sweep) {
    check_cancelled(job);
    float furthest = 0;
    for (const std::vector<std::size_t>* cells : {&even, &odd}) {
      std::fill(moved.begin(), moved.end(), 0.0f);
      parallel_for(moved.size(), [&](std::size_t block) {
        const std::size_t end = std::min(cells->size(), (block + 1) * kBlock);
        for (std::size_t k = block * kBlock; k < end; ++k) {
          const std::size_t i = (*cells)[k];
          const float step = kRelaxation * (neighbor_mean(i) - grid.heights[i]);
          grid.heights[i] += step;
          moved[block] = std::max(moved[block], std::abs(step));
        }
      });
      furthest = std::max(furthest, *std::max_element(moved.begin(), moved.end()));
    }
    if (furthest < kTolerance) return;
  }
}

}  // namespace

void fill_holes(HeightGrid& grid, Job* job) {
  std::vector<std::size_t> even, odd;
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x)
      if (std::isnan(grid.heights[grid.index(x, y)]))
        ((x + y) % 2 == 0 ? even : odd).push_back(grid.index(x, y));
  const std::size_t unknown = even.size() + odd.size();
  if (unknown == 0 || unknown == grid.heights.size()) return;

  // From the filled grid of half the resolution, which has the hole's wide shape, on.
  HeightGrid coarse = halved(grid);
  fill_holes(coarse, job);
  for (const std::vector<std::size_t>* cells : {&even, &odd})
    for (const std::size_t i : *cells) {
      const auto nx = static_cast<std::size_t>(grid.nx);
      grid.heights[i] = interpolated(coarse, static_cast<int>(i % nx), static_cast<int>(i / nx));
    }
  relax(grid, even, odd, job);
}

}  // namespace talus
