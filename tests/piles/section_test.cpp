#include "talus/piles/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mesh/shapes.h"
#include "talus/base/error.h"
#include "talus/field/shape.h"

namespace talus {
namespace {

using Color = std::array<std::uint8_t, 3>;

std::map<Color, int> count_colors(const Image& image) {
  std::map<Color, int> counts;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    ++counts[{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}];
  return counts;
}

Color color_at(const Image& image, int x, int y) {
  const auto i = static_cast<std::size_t>(3 * (x + image.width * y));
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

// Unit cubes with their lower corners at these places.
InstanceTable cubes(std::initializer_list<Vec3> places) {
  InstanceTable table;
  table.prototypes = {std::make_shared<const TriangleMesh>(test::unit_cube())};
  for (const Vec3& place : places) table.instances.push_back({.position = place});
  return table;
}

TEST(Section, ShowsWhatItCutsWhereItLies) {
  const Image image = draw_section(cubes({{0, 0, 0}, {3, 1, 0.2}, {1, 1, 5}}),
                                   {.height = 0.5, .min = {0, 0}, .max = {4, 2}, .width = 400});
  ASSERT_EQ(image.width, 400);
  ASSERT_EQ(image.height, 200);
  const Color gap = color_at(image, 150, 50), first = color_at(image, 50, 150),
              second = color_at(image, 350, 50);
  EXPECT_NE(first, gap);
  EXPECT_NE(second, gap);
  EXPECT_NE(first, second);
  const auto counts = count_colors(image);
  EXPECT_EQ(counts.at(first), 100 * 100);
  EXPECT_EQ(counts.at(second), 100 * 100);
  EXPECT_EQ(counts.at(gap), 400 * 200 - 2 * 100 * 100) << "the third cube lies above";
}

TEST(Section, RefusesWhatHasNoExtentOrIsTooHigh) {
  const InstanceTable table = cubes({{0, 0, 0}});
  EXPECT_THROW(draw_section(table, {.min = {0, 0}, .max = {0, 1}}), Error);
  EXPECT_THROW(draw_section(table, {.min = {0, 0}, .max = {1, 1000}}), Error);
}

TEST(Section, MarksAreDotsOfTheirRadius) {
  const std::array<Vec2, 1> marks{Vec2(1, 1)};
  const Image image =
      draw_section({}, {.height = 0, .min = {0, 0}, .max = {2, 2}, .width = 200}, marks, 0.5);
  const auto counts = count_colors(image);
  const Color red = color_at(image, 100, 100);
  EXPECT_GT(red[0], 2 * red[1]);
  EXPECT_NEAR(counts.at(red), std::acos(-1.0) * 50 * 50, 200);
}

TEST(Section, ShowsAsMuchVoidAsTheTilesTell) {
  for (const double depth : {0.0, 0.15}) {
    TileParams params{.voxels_per_edge = 30};
    params.weathering.depth = depth;
    const auto tiles = std::make_shared<const TileSet>(TileSet::make(params, 2));
    const Pile pile = fill(ShapeSupport(Box{.center = Vec3(9), .size = Vec3(18)}), tiles,
                           {.stone_size = {1, RelativeLength::Unit::metres}});
    // Pixels at the edge of a gap do not count.
    constexpr int kHeights = 4, kWidth = 900;
    double share = 0;
    for (int k = 0; k < kHeights; ++k) {
      const Image image =
          draw_section(instances(pile),
                       {.height = 6.1 + 0.7 * k, .min = {4, 4}, .max = {14, 14}, .width = kWidth});
      share += count_colors(image)[{26, 24, 23}] / (1.0 * kHeights * kWidth * kWidth);
    }
    EXPECT_NEAR(share, tiles->stats().void_fraction, 0.025) << depth;
  }
}

TEST(Section, ContactsLieBetweenTwoStones) {
  const auto tiles = std::make_shared<const TileSet>(TileSet::make({.voxels_per_edge = 30}, 2));
  const Pile pile = fill(ShapeSupport(Box{.center = Vec3(6), .size = Vec3(12)}), tiles,
                         {.stone_size = {1, RelativeLength::Unit::metres}});
  std::vector<Vec2> found = contacts_near(pile, 6);
  ASSERT_GT(found.size(), 50u);
  // Within the pile each is known to both.
  const auto is_inner = [](const Vec2& p) {
    return std::min(p.x, p.y) > 3 && std::max(p.x, p.y) < 9;
  };
  std::map<std::pair<double, double>, int> times;
  for (const Vec2& p : found)
    if (is_inner(p)) ++times[{std::round(p.x * 1e6), std::round(p.y * 1e6)}];
  int paired = 0, single = 0;
  for (const auto& [place, n] : times) n % 2 == 0 ? ++paired : ++single;
  EXPECT_GT(paired, 20 * single) << "a contact that only one stone kept is rare";
}

}  // namespace
}  // namespace talus
