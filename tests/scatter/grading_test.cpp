#include "talus/scatter/grading.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "talus/base/error.h"
#include "talus/scatter/make_plots.h"

namespace talus {
namespace {

using enum GradingLaw;
using enum GradingMeasure;

double sum_of_shares(const std::vector<SizeClass>& classes) {
  return std::accumulate(classes.begin(), classes.end(), 0.0,
                         [](double sum, const SizeClass& size) { return sum + size.area_share; });
}

GradingParams grading(GradingLaw law, GradingMeasure measure) {
  return {.law = law,
          .measure = measure,
          .points = {{0.03, 0.02}, {0.06, 0.3}, {0.15, 0.75}, {0.3, 1}},
          .scale = 0.15,
          .exponent = law == power_law ? 2.5 : 2,
          .sizes = {0.03, 0.3},
          .coverage = 0.5};
}

RC_GTEST_PROP(Grading, ClassesCoverWhatIsAskedFromTheLargestDown, ()) {
  GradingParams params = grading(*rc::gen::element(curve, rosin_rammler, power_law),
                                 *rc::gen::element(mass, area, number));
  params.exponent = *rc::gen::inRange(5, 60) * 0.1;
  params.steps = *rc::gen::inRange(1, 20);
  params.coverage = *rc::gen::inRange(1, 100) * 0.01;
  const std::vector<SizeClass> classes = classes_of_grading(params, "grading");
  RC_ASSERT(std::abs(sum_of_shares(classes) - params.coverage) < 1e-12);
  for (std::size_t k = 1; k < classes.size(); ++k)
    RC_ASSERT(classes[k].radius < classes[k - 1].radius);
}

TEST(Grading, PlotsFollowEachLawByEachMeasure) {
  for (const auto& [law, measure] :
       {std::pair(curve, mass), std::pair(rosin_rammler, area), std::pair(power_law, number)}) {
    GradingParams params = grading(law, measure);
    params.steps = 8;
    const PlotParams plots{.classes = classes_of_grading(params, "grading")};
    const PlotResult result = make_plots(plots, 1, {{0, 0}, {6, 6}});
    EXPECT_LT(grading_error(params, plot_sizes(result.plots)), 0.09) << static_cast<int>(law);
    EXPECT_NEAR(result.report.coverage(), 0.5, 0.01);
  }
}

TEST(Grading, ErrorIsThatOfTheFarthestStone) {
  // Quantiles of a Weibull distribution by number, in the middle of equal steps.
  GradingParams params = grading(rosin_rammler, number);
  params.sizes = {1e-4, 100};
  std::vector<double> sizes;
  for (int i = 0; i < 50; ++i)
    sizes.push_back(params.scale * std::sqrt(-std::log(1 - (i + 0.5) / 50)));
  EXPECT_NEAR(grading_error(params, sizes), 0.01, 1e-5);
  // Ten of them gone from the lower end.
  sizes.erase(sizes.begin(), sizes.begin() + 10);
  EXPECT_NEAR(grading_error(params, sizes), 0.21, 1e-2);
  EXPECT_EQ(grading_error(params, {}), 1);
}

TEST(Grading, OfAPowerLawCountsStonesByTheirSizes) {
  // Twice as large, a quarter as many: between 1 and 2 cm are 12 of 15 stones of 1 to 4 cm.
  GradingParams params = grading(power_law, number);
  params.exponent = 2;
  params.sizes = {0.01, 0.04};
  std::vector<double> sizes(12, 0.0199999);
  sizes.insert(sizes.end(), 3, 0.04);
  EXPECT_NEAR(grading_error(params, sizes), 0.8, 1e-4);  // none of the 12 is finer than the largest
  sizes.assign(12, 0.02);
  sizes.insert(sizes.begin(), 6, 0.0100001);
  EXPECT_NEAR(grading_error(params, sizes), 0.467, 1e-3);
}

TEST(Grading, SizesOfPlotsAreThoseOfDisksWithTheirAreas) {
  Plots plots;
  plots.plots.push_back({.corner_count = 4});
  plots.corners = {{1, 1}, {3, 1}, {3, 2}, {1, 2}};
  EXPECT_NEAR(plot_sizes(plots)[0], 2 * std::sqrt(2 / 3.14159265), 1e-8);
}

std::string complaint(const GradingParams& params) {
  try {
    classes_of_grading(params, "grading");
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Grading, RefusesWhatIsNone) {
  GradingParams params = grading(curve, mass);
  params.points = {{0.1, 1}};
  EXPECT_EQ(complaint(params), "grading.points: a curve needs two points at least");
  params.points = {{0.1, 0.5}, {0.2, 0.4}};
  EXPECT_EQ(complaint(params),
            "grading.points[1] = [0.2, 0.4]: sizes must be positive and increase, and the finer "
            "fractions not decrease from 0 to 1");
  params.points = {{0.1, 0.5}, {0.2, 0.5}};
  EXPECT_EQ(complaint(params), "grading.points: all finer fractions are 0.5");
  params = grading(power_law, mass);
  params.sizes = {0.2, 0.2};
  EXPECT_EQ(complaint(params),
            "grading.sizes = [0.2, 0.2] m: the largest must exceed the smallest");
}

}  // namespace
}  // namespace talus
