// The method of [Sakurai2010] as printed, with flags of pixels, beside ours with exact polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "talus/base/hash.h"
#include "talus/scatter/make_plots.h"

namespace talus {
namespace {

constexpr int kPixels = 1000;

struct Pixel {
  int x, y;
};

std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kPixels + x); }

// Calls `body(x, y, squared distance)` for the pixels within a radius.
void for_disk(const Pixel& center, double radius, auto&& body) {
  const int reach = static_cast<int>(radius);
  for (int y = std::max(0, center.y - reach); y <= std::min(kPixels - 1, center.y + reach); ++y)
    for (int x = std::max(0, center.x - reach); x <= std::min(kPixels - 1, center.x + reach); ++x) {
      const int square = (x - center.x) * (x - center.x) + (y - center.y) * (y - center.y);
      if (square < radius * radius) body(x, y, square);
    }
}

// The numbers 0 to n - 1 in a random order.
std::vector<int> shuffled(int n, std::uint64_t seed) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return hash(seed, Purpose::seed_position, a) < hash(seed, Purpose::seed_position, b);
  });
  return order;
}

// Figure 4: random pixels become sites unless flagged; a site flags its disk. Every pixel is tried.
std::vector<Pixel> pixel_sites(double distance, std::uint64_t seed) {
  std::vector<bool> flags(kPixels * kPixels);
  std::vector<Pixel> sites;
  for (const int i : shuffled(kPixels * kPixels, seed)) {
    const Pixel p{i % kPixels, i / kPixels};
    if (flags[index(p.x, p.y)]) continue;
    sites.push_back(p);
    for_disk(p, distance, [&](int x, int y, int) { flags[index(x, y)] = true; });
  }
  return sites;
}

// The pixels of each site's cell.
std::vector<std::vector<std::size_t>> pixel_cells(const std::vector<Pixel>& sites,
                                                  double distance) {
  std::vector<int> nearest(kPixels * kPixels, -1), squares(kPixels * kPixels, 1 << 30);
  for (std::size_t s = 0; s < sites.size(); ++s)
    for_disk(sites[s], distance + 1, [&](int x, int y, int square) {
      if (square >= squares[index(x, y)]) return;
      squares[index(x, y)] = square;
      nearest[index(x, y)] = static_cast<int>(s);
    });
  std::vector<std::vector<std::size_t>> cells(sites.size());
  for (std::size_t i = 0; i < nearest.size(); ++i)
    cells[static_cast<std::size_t>(nearest[i])].push_back(i);
  return cells;
}

struct ClassResult {
  double sites = 0, plots = 0, share = 0;
};

// Figure 7: random cells are taken unless a pixel of theirs is flagged, until the area is reached.
std::vector<ClassResult> pixel_choice(const std::vector<SizeClass>& classes, std::uint64_t seed) {
  std::vector<bool> flags(kPixels * kPixels);
  std::vector<ClassResult> results;
  for (const SizeClass& size : classes) {
    const double distance = 0.93 * 100 * size.radius;
    const std::vector<Pixel> sites = pixel_sites(distance, seed + results.size());
    const auto cells = pixel_cells(sites, distance);
    ClassResult result{.sites = static_cast<double>(sites.size())};
    for (const int s : shuffled(static_cast<int>(sites.size()), ~seed)) {
      const auto& cell = cells[static_cast<std::size_t>(s)];
      const double share = static_cast<double>(cell.size()) / (kPixels * kPixels);
      if (result.share + 0.5 * share > size.area_share) break;
      if (std::any_of(cell.begin(), cell.end(), [&](std::size_t i) { return flags[i]; })) continue;
      for (const std::size_t i : cell) flags[i] = true;
      result.share += share;
      ++result.plots;
    }
    results.push_back(result);
  }
  return results;
}

TEST(PixelFlags, GiveTheCountsAndSharesOfExactPolygons) {
  // Figure 1, a pixel a centimetre.
  const PlotParams params{.classes = {{.radius = 0.9, .area_share = 0.2},
                                      {.radius = 0.3, .area_share = 0.24},
                                      {.radius = 0.1, .area_share = 0.56}}};
  constexpr int kRuns = 4;
  std::vector<ClassResult> pixels(3), polygons(3);
  for (std::uint64_t run = 1; run <= kRuns; ++run) {
    const std::vector<ClassResult> by_pixels = pixel_choice(params.classes, 100 * run);
    const PlotReport report = make_bounded_plots(params, run, {{0, 0}, {10, 10}}).report;
    for (std::size_t k = 0; k < 3; ++k) {
      pixels[k].sites += by_pixels[k].sites / kRuns;
      pixels[k].plots += by_pixels[k].plots / kRuns;
      pixels[k].share += by_pixels[k].share / kRuns;
      polygons[k].sites += static_cast<double>(report.classes[k].sites) / kRuns;
      polygons[k].plots += static_cast<double>(report.classes[k].plots) / kRuns;
      polygons[k].share += report.classes[k].area / report.area / kRuns;
    }
  }
  // The smallest distance is 9.3 pixels, which rounding makes wider by a few percent.
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(pixels[k].sites / polygons[k].sites, 1, 0.08) << k;
    EXPECT_NEAR(pixels[k].plots / polygons[k].plots, 1, 0.1) << k;
    EXPECT_NEAR(pixels[k].share, polygons[k].share, 0.02) << k;
  }
}

}  // namespace
}  // namespace talus
