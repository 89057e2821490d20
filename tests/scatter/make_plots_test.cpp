#include "talus/scatter/make_plots.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "talus/base/parallel.h"

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

RC_GTEST_PROP(Plots, OfRegionsFitTogether, ()) {
  const PlotParams params{
      .classes = {{.radius = 0.9, .area_share = 0.2}, {.radius = 0.7, .area_share = 0.4}}};
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

}  // namespace
}  // namespace talus
