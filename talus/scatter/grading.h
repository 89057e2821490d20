// Sizes of stones as geologists and engineers state them, turned into size classes.
#pragma once

#include <vector>

#include "talus/base/describe.h"
#include "talus/scatter/plot_params.h"
#include "talus/scatter/plots.h"

namespace talus {

// How sizes are distributed.
enum class GradingLaw {
  curve,          // through given points, straight over the logarithm of size
  rosin_rammler,  // a Weibull distribution: 1 - exp(-(size / scale)^exponent) is finer
  power_law,      // stones larger than a size are as size^-exponent in number
};

// What the finer fraction is a fraction of. A stone's mass is taken as its size cubed.
enum class GradingMeasure { mass, area, number };

struct GradingPoint {
  double size = 0;     // m
  double passing = 0;  // fraction that is finer
};

// A stone's size is the diameter of the disk with its plot's area.
struct GradingParams {
  GradingLaw law = GradingLaw::rosin_rammler;
  GradingMeasure measure = GradingMeasure::mass;
  std::vector<GradingPoint> points;
  double scale = 0.2;
  double exponent = 2;
  Range sizes{0.05, 0.5};
  int steps = 10;
  double coverage = 0.6;

  static void describe(auto& p, auto&& field) {
    field(p.law, Field{.name = "law",
                       .help = "curve: through points, straight over the logarithm of size; "
                               "rosin_rammler: 1 - exp(-(size / scale)^exponent) is finer, a "
                               "Weibull distribution; power_law: stones larger than a size are as "
                               "size^-exponent in number, whatever the measure"});
    field(p.measure, Field{.name = "measure",
                           .help = "what the finer fraction is a fraction of; mass is as size "
                                   "cubed, area is that of the plan"});
    field(p.points, Field{.name = "points",
                          .help = "of a curve, two at least: size and the fraction that is finer, "
                                  "both increasing"});
    field(p.scale, Field{.name = "scale",
                         .help = "of rosin_rammler: the size that 63 % are finer than",
                         .unit = "m",
                         .min = 1e-4,
                         .max = 1e5});
    field(
        p.exponent,
        Field{.name = "exponent", .help = "of rosin_rammler and power_law", .min = 0.1, .max = 20});
    field(p.sizes, Field{.name = "sizes",
                         .help = "smallest and largest stones of rosin_rammler and power_law; what "
                                 "is beyond is left out",
                         .unit = "m",
                         .min = 1e-4,
                         .max = 1e5});
    field(p.steps, Field{.name = "steps",
                         .help = "number of size classes, each as much larger than the one before",
                         .min = 1,
                         .max = 32});
    field(p.coverage, Field{.name = "coverage",
                            .help = "of the ground's area, that all stones together cover",
                            .min = 0,
                            .max = 1});
  }
};

// The classes that come nearest to the grading, from the largest to the smallest; those without a
// share are left out. Throws `Error` (usage), with names that begin with `path`.
std::vector<SizeClass> classes_of_grading(const GradingParams& params, const std::string& path);

// Sizes of plots, metres.
std::vector<double> plot_sizes(const Plots& plots);

// How far stones of these sizes are from the grading: the largest difference between the fractions
// that are finer than a size, between 0 and 1.
double grading_error(const GradingParams& params, std::vector<double> sizes);

}  // namespace talus
