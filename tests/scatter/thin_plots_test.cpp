#include "talus/scatter/thin_plots.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "talus/scatter/make_plots.h"

namespace talus {
namespace {

Plots gravel() {
  return make_plots({.classes = {{.radius = 0.1, .area_share = 1}}}, 1, {{0, 0}, {10, 10}}).plots;
}

std::vector<std::uint64_t> keys(const Plots& plots) {
  std::vector<std::uint64_t> result;
  for (const Plot& plot : plots.plots) result.push_back(plot.key);
  std::sort(result.begin(), result.end());
  return result;
}

TEST(ThinPlots, KeepsTheShareAskedWhereItIsAsked) {
  const Plots all = gravel();
  Plots thinned = all;
  thin_plots(thinned, [](const Plot& plot) { return plot.site.x < 5 ? 0.3 : 1.0; });
  const auto left_of = [](const Plots& plots) {
    return std::count_if(plots.plots.begin(), plots.plots.end(),
                         [](const Plot& plot) { return plot.site.x < 5; });
  };
  EXPECT_NEAR(double(left_of(thinned)) / double(left_of(all)), 0.3, 0.03);
  EXPECT_EQ(std::ssize(thinned.plots) - left_of(thinned), std::ssize(all.plots) - left_of(all));
}

TEST(ThinPlots, KeepsPlotsWithTheirCornersAndThoseOfALowerDensityInAHigher) {
  const Plots all = gravel();
  Plots few = all, more = all;
  thin_plots(few, [](const Plot&) { return 0.2; });
  thin_plots(more, [](const Plot&) { return 0.6; });
  const auto fewer = keys(few), many = keys(more);
  EXPECT_TRUE(std::includes(many.begin(), many.end(), fewer.begin(), fewer.end()));
  std::size_t i = 0;
  for (const Plot& plot : few.plots) {
    while (all.plots[i].key != plot.key) ++i;
    const auto before = all.corners_of(all.plots[i]), after = few.corners_of(plot);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin(), after.end()));
  }
}

TEST(ThinPlots, KeepsAllOrNone) {
  const Plots all = gravel();
  Plots none = all, same = all;
  thin_plots(none, [](const Plot&) { return 0.0; });
  thin_plots(same, [](const Plot&) { return 1.0; });
  EXPECT_TRUE(none.plots.empty() && none.corners.empty());
  EXPECT_EQ(same.corners, all.corners);
}

}  // namespace
}  // namespace talus
