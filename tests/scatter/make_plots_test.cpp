#include "talus/scatter/make_plots.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "talus/scatter/grading.h"

namespace talus {
namespace {

// The paper's mixed scene, a pixel a centimetre.
PlotParams figure_1() {
  return {.classes = {{.radius = 0.9, .area_share = 0.2},
                      {.radius = 0.3, .area_share = 0.24},
                      {.radius = 0.1, .area_share = 0.56}}};
}
constexpr Box2 kFigureBounds{{0, 0}, {10, 10}};

double cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// An edge of `a` with all of `b` on its outer side; metres are exact, and so is this nearly.
bool separates(std::span<const Vec2> a, std::span<const Vec2> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 &from = a[i], &to = a[(i + 1) % a.size()];
    if (std::all_of(b.begin(), b.end(), [&](const Vec2& p) { return cross(from, to, p) <= 0; }))
      return true;
  }
  return false;
}

int overlapping_pairs(const Plots& plots) {
  std::vector<Plot> sorted = plots.plots;
  std::sort(sorted.begin(), sorted.end(),
            [](const Plot& a, const Plot& b) { return a.site.x < b.site.x; });
  int pairs = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].site.x - sorted[i].site.x < 4; ++j) {
      if (std::abs(sorted[j].site.y - sorted[i].site.y) > 4) continue;
      const auto a = plots.corners_of(sorted[i]), b = plots.corners_of(sorted[j]);
      pairs += !separates(a, b) && !separates(b, a);
    }
  return pairs;
}

// In an order that does not depend on how they were made.
std::vector<std::vector<Vec2>> sorted_corners(const std::vector<PlotResult>& parts) {
  std::vector<std::pair<std::uint64_t, std::vector<Vec2>>> keyed;
  for (const PlotResult& part : parts)
    for (const Plot& plot : part.plots.plots) {
      const auto corners = part.plots.corners_of(plot);
      keyed.push_back({plot.key, {corners.begin(), corners.end()}});
    }
  std::sort(keyed.begin(), keyed.end(), [](auto& a, auto& b) { return a.first < b.first; });
  std::vector<std::vector<Vec2>> result;
  for (auto& [key, corners] : keyed) result.push_back(std::move(corners));
  return result;
}

TEST(BoundedPlots, HaveTheCountsOfThePapersFigures) {
  const PlotResult result = make_bounded_plots(figure_1(), 1, kFigureBounds);
  const auto& classes = result.report.classes;
  EXPECT_NEAR(static_cast<double>(classes[0].sites), 110, 8);
  EXPECT_NEAR(static_cast<double>(classes[1].sites), 930, 40);
  EXPECT_NEAR(static_cast<double>(classes[2].sites), 8150, 100);
  EXPECT_NEAR(classes[2].expected_sites, 8912.7, 0.1);
}

TEST(BoundedPlots, DoNotOverlapAndStayWithinTheBounds) {
  const PlotResult result = make_bounded_plots(figure_1(), 5, kFigureBounds);
  EXPECT_EQ(overlapping_pairs(result.plots), 0);
  for (const Vec2& p : result.plots.corners) {
    EXPECT_GE(std::min(p.x, p.y), 0);
    EXPECT_LE(std::max(p.x, p.y), 10);
  }
}

TEST(BoundedPlots, FillGroundThatIsLongAndNarrow) {
  const PlotParams params{.classes = {{.radius = 0.3, .area_share = 0.5}}};
  const PlotResult result = make_bounded_plots(params, 1, {{0, -1}, {8'000, 0}});
  EXPECT_NEAR(result.report.coverage(), 0.5, 1e-4);
  EXPECT_NEAR(static_cast<double>(result.report.classes[0].sites), 80'000, 8'000);
}

TEST(Plots, MeetTheirSharesWithinHalfACellOfEachBlock) {
  PlotParams params = figure_1();
  params.classes[2].area_share = 0.3;
  const PlotResult result = make_plots(params, 2, {{0, 0}, {30, 30}});
  for (const ClassReport& report : result.report.classes) {
    const double cell = 2 * report.radius * report.radius;
    EXPECT_NEAR(report.area, *report.asked_area, 0.5 * cell * double(result.report.blocks));
    EXPECT_EQ(report.full_blocks, 0);
  }
}

TEST(Plots, TakeEveryCellOfAClassThatIsToCoverEverything) {
  const PlotParams params{.classes = {{.radius = 0.5, .area_share = 1}}};
  const PlotResult result = make_plots(params, 4, {{0, 0}, {8, 8}});
  EXPECT_EQ(result.report.classes[0].plots, result.report.classes[0].sites);
  EXPECT_NEAR(result.report.coverage(), 1, 0.02);  // cells reach out of their blocks and into them
}

TEST(Plots, AreOfTheSizeThatTheirClassSays) {
  const PlotParams params{.classes = {{.radius = 0.1, .area_share = 1}}};
  const Plots plots = make_plots(params, 4, {{0, 0}, {12, 12}}).plots;
  double size = 0, area = 0, squares = 0;
  for (const double s : plot_sizes(plots)) {
    const double a = 0.785398 * s * s;
    size += s;
    area += a;
    squares += a * a;
  }
  const double n = static_cast<double>(plots.plots.size()), mean = area / n;
  EXPECT_NEAR(size / n, kSizePerRadius * 0.1, 0.001);
  EXPECT_NEAR(mean, 1.24 * 0.01, 0.0002);
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean) / mean, 1.0 / 7, 0.01);
  for (const Plot& plot : plots.plots)
    for (const Vec2& corner : plots.corners_of(plot))
      EXPECT_LT(std::hypot(corner.x - plot.site.x, corner.y - plot.site.y), 0.1);
}

TEST(Plots, CountWhatIsCounted) {
  PlotParams params = figure_1();
  params.classes[1].count = 77;
  const PlotResult result = make_bounded_plots(params, 1, kFigureBounds);
  EXPECT_EQ(result.report.classes[1].plots, 77);
  EXPECT_FALSE(result.report.classes[1].asked_area);
  EXPECT_EQ(result.report.classes[1].full_blocks, 0);
}

TEST(Plots, TellWhereNoFurtherCellFits) {
  const PlotReport report = make_bounded_plots(figure_1(), 1, kFigureBounds).report;
  EXPECT_EQ(report.classes[1].full_blocks, 0);
  EXPECT_EQ(report.classes[2].full_blocks, 1);
  EXPECT_LT(report.classes[2].area, 0.5 * report.area);
}

// Shortest distance from a corner to the line through an edge that has all others on one side.
double width(std::span<const Vec2> corners) {
  double width = 1e9;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    double farthest = 0;
    for (const Vec2& p : corners) farthest = std::max(farthest, cross(a, b, p));
    width = std::min(width, farthest / std::hypot(b.x - a.x, b.y - a.y));
  }
  return width;
}

TEST(Gaps, FillToTheCoverageAskedWithStonesNeitherTinyNorSlivers) {
  PlotParams params = figure_1();
  params.gaps = GapParams{.coverage = 0.96, .radius_min = 0.02};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const PlotResult result = make_bounded_plots(params, seed, kFigureBounds);
    EXPECT_NEAR(result.report.coverage(), 0.96, 1e-4);
    EXPECT_EQ(overlapping_pairs(result.plots), 0);
    for (const Plot& plot : result.plots.plots) {
      const double radius = result.report.classes[plot.size_class].radius;
      EXPECT_GT(width(result.plots.corners_of(plot)), 0.3 * radius);
    }
  }
}

TEST(Gaps, AreSmallerThanTheClassesInStepsOfAHalf) {
  PlotParams params = figure_1();
  params.gaps = GapParams{.coverage = 0.9, .radius_min = 0.02};
  EXPECT_EQ(class_radii(params), (std::vector<double>{0.9, 0.3, 0.1, 0.05, 0.025}));
}

RC_GTEST_PROP(Plots, OfRegionsFitTogether, ()) {
  PlotParams params{
      .classes = {{.radius = 0.9, .area_share = 0.2}, {.radius = 0.7, .area_share = 0.4}}};
  if (*rc::gen::arbitrary<bool>()) params.gaps = GapParams{.coverage = 0.8, .radius_min = 0.35};
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const double far = *rc::gen::element(0.0, -40.0, 1e6, -1e6);
  const double x0 = far + *rc::gen::inRange(-2000, 2000) * 0.01, x1 = x0 + 3.37, x2 = x1 + 8.25;
  const double y0 = -far - 5.003, y1 = y0 + 6;
  const PlotResult whole = make_plots(params, seed, {{x0, y0}, {x2, y1}});
  const PlotResult left = make_plots(params, seed, {{x0, y0}, {x1, y1}});
  const PlotResult right = make_plots(params, seed, {{x1, y0}, {x2, y1}});
  RC_ASSERT(!left.plots.plots.empty() && !right.plots.plots.empty());
  RC_ASSERT(sorted_corners({left, right}) == sorted_corners({whole}));
  RC_ASSERT(overlapping_pairs(whole.plots) == 0);
}

TEST(Gaps, OfABlockAreFilledWhateverOtherBlocksNeed) {
  // Some blocks need a stone or two, most none.
  const PlotParams params{.classes = {{.radius = 1, .area_share = 0.4}},
                          .gaps = GapParams{.coverage = 0.4, .radius_min = 0.3}};
  constexpr double kBlock = 16;
  const PlotResult whole = make_plots(params, 3, {{0, 0}, {12 * kBlock, 12 * kBlock}});
  std::vector<PlotResult> blocks;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      blocks.push_back(
          make_plots(params, 3, {{x * kBlock, y * kBlock}, {(x + 1) * kBlock, (y + 1) * kBlock}}));
  EXPECT_GT(whole.report.classes[1].plots, 0);
  EXPECT_TRUE(sorted_corners(blocks) == sorted_corners({whole}));
}

TEST(Plots, OfAllPiecesAreThoseOfTheRegion) {
  PlotParams params{
      .classes = {{.radius = 0.5, .area_share = 0.3}, {.radius = 0.02, .area_share = 0.4}}};
  const Box2 region{{-12.3, 4.56}, {12.3, 15}};
  const std::vector<Box2> pieces = cut_into_pieces(params, region);
  ASSERT_GT(pieces.size(), 1);
  std::vector<PlotResult> results;
  PlotReport report;
  for (const Box2& piece : pieces)
    report.add(results.emplace_back(make_plots(params, 9, piece)).report);
  const PlotResult whole = make_plots(params, 9, region);
  EXPECT_TRUE(sorted_corners(results) == sorted_corners({whole}));
  EXPECT_EQ(report.blocks, whole.report.blocks);
  EXPECT_EQ(report.classes[1].plots, whole.report.classes[1].plots);
  EXPECT_NEAR(report.coverage(), whole.report.coverage(), 1e-12);
}

TEST(Plots, AreTheSameForOneAndTwoThreads) {
  const auto made = [](int threads) {
    const ThreadLimit limit(threads);
    return make_plots(figure_1(), 3, {{0, 0}, {20, 20}}).plots;
  };
  const Plots one = made(1), two = made(2);
  EXPECT_EQ(one.corners, two.corners);
  EXPECT_TRUE(std::equal(one.plots.begin(), one.plots.end(), two.plots.begin(), two.plots.end(),
                         [](const Plot& a, const Plot& b) { return a.key == b.key; }));
}

TEST(Plots, AreAboutAsManyAsExpected) {
  PlotParams params = figure_1();
  params.classes[2].area_share = 0.3;
  const auto made = [&] {
    return static_cast<double>(make_bounded_plots(params, 1, kFigureBounds).plots.plots.size());
  };
  EXPECT_NEAR(made() / expected_plots(params, 100), 1, 0.1);
  params.gaps = GapParams{.coverage = 0.92};
  EXPECT_NEAR(made() / expected_plots(params, 100), 1, 0.2);
  params = {.classes = {{.radius = 0.3, .count = 50}}};
  EXPECT_EQ(expected_plots(params, 100), 50);
}

TEST(Plots, DifferBySeed) {
  const Box2 region{{0, 0}, {20, 20}};
  EXPECT_NE(make_plots(figure_1(), 3, region).plots.corners,
            make_plots(figure_1(), 4, region).plots.corners);
}

// What is said about params that are refused.
std::string complaint(const PlotParams& params, const Box2& ground, bool bounded = false) {
  try {
    bounded ? make_bounded_plots(params, 1, ground) : make_plots(params, 1, ground);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Plots, RefuseWhatCannotBeDone) {
  const Box2 ground{{0, 0}, {10, 10}};
  PlotParams params = figure_1();
  params.classes[0].area_share = 0.3;
  EXPECT_EQ(complaint(params, ground),
            "scatter.classes: area shares are 1.1 in sum; stones cannot cover more than 1");
  EXPECT_EQ(complaint({}, ground), "scatter.classes is empty; give one size at least");
  EXPECT_EQ(complaint({.classes = {{.radius = 0.1}, {.radius = 0.2}}}, ground),
            "scatter.classes[1].radius = 0.2 m is larger than 0.1 m before it; give sizes from the "
            "largest to the smallest");
  EXPECT_EQ(complaint({.classes = {{.radius = 11}}}, ground, true),
            "scatter.classes[0].radius = 11 m is larger than the ground of 10 m x 10 m; it may be "
            "10 m at most");
  EXPECT_EQ(complaint(figure_1(), {{0, 0}, {10, 0}}, true),
            "scatter: the ground of 10 m x 0 m has no area");
  EXPECT_EQ(complaint(figure_1(), {{5, 5}, {5, 6}}),
            "scatter: the region (5, 5) to (5, 6) m has no area");
  EXPECT_EQ(complaint(figure_1(), {{1e10, 0}, {2e10, 1}}),
            "scatter: the region reaches out to 2e+10 m; stones of this size can lie within "
            "1.07374e+09 m of (0, 0)");
  EXPECT_EQ(
      complaint({.classes = {{.radius = 10}, {.radius = 0.001}}}, ground),
      "scatter: stones of radius 0.001 m are 2.1e+10 in a block of 160 m; radii of 0.026 m and "
      "more can be made");
  EXPECT_EQ(
      complaint({.classes = {{.radius = 0.001}}}, {{0, 0}, {10'000, 0.001}}, true),
      "scatter: stones of radius 0.001 m are 7.9e+06 in a block of 10000 m; radii of 0.26 m and "
      "more can be made");
  params = figure_1();
  params.block_size = 14;
  EXPECT_EQ(complaint(params, ground),
            "scatter.block_size = 14 m must be at least 14.4 m, 16 radii of the largest stones");
  params = figure_1();
  params.classes[2].count = 3;
  EXPECT_EQ(complaint(params, ground),
            "scatter.classes[2].count is for bounded ground; give area_share");
  params.gaps = GapParams{.coverage = 0.99};
  EXPECT_EQ(complaint(params, ground, true),
            "scatter.gaps.coverage = 0.99 is out of range; it must be from 0 to 0.97");
  params.gaps = GapParams{.radius_min = 0.06};
  EXPECT_EQ(complaint(params, ground, true),
            "scatter.gaps.radius_min = 0.06 m is more than 0.05 m, half the radius of the smallest "
            "class");
}

}  // namespace
}  // namespace talus
