// How ground is divided into plots for stones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/base/describe.h"

namespace talus {

constexpr double kCoverageMax = 0.97;

// Mean size of plots, in radii of their class: the diameter of a disk with their area.
constexpr double kSizePerRadius = 1.25;

// Plots of about one size. A plot's area is 1.24 radius^2 in the mean, with a standard deviation of
// a seventh of that; its longest reach from the site is less than the radius.
struct SizeClass {
  double radius = 0.1;
  double area_share = 0.5;
  std::optional<int> count;

  static void describe(auto& p, auto&& field) {
    field(p.radius, Field{.name = "radius",
                          .help = "sites of stones are about as far apart",
                          .unit = "m",
                          .min = 1e-4,
                          .max = 1e5});
    field(p.area_share, Field{.name = "area_share",
                              .help = "of the ground's area, that these stones cover",
                              .min = 0,
                              .max = 1});
    field(p.count, Field{.name = "count",
                         .help = "number of stones on bounded ground, in place of area_share",
                         .min = 0,
                         .max = 1e9});
  }
};

// Small stones in what the classes leave free, in sizes that halve.
struct GapParams {
  double coverage = 0.9;
  double radius_min = 0.02;

  static void describe(auto& p, auto&& field) {
    field(p.coverage, Field{.name = "coverage",
                            .help = "share of the ground's area that all stones are to cover",
                            .min = 0,
                            .max = kCoverageMax});
    field(p.radius_min, Field{.name = "radius_min",
                              .help = "no smaller stones",
                              .unit = "m",
                              .min = 1e-4,
                              .max = 1e5});
  }
};

struct PlotParams {
  std::vector<SizeClass> classes;  // from the largest to the smallest
  std::optional<GapParams> gaps;
  std::optional<double> block_size;

  static void describe(auto& p, auto&& field) {
    field(p.classes, Field{.name = "classes", .help = "sizes, from the largest to the smallest"});
    field(p.gaps, Field{.name = "gaps", .help = "small stones that fill what is left free"});
    field(p.block_size,
          Field{.name = "block_size",
                .help = "edge of the squares in which each share is met, at least 16 radii of the "
                        "largest stones, which is the default",
                .unit = "m",
                .min = 1e-3,
                .max = 1e6});
  }
};

// The classes, and after them those that fill their gaps: half as large as the last, a quarter and
// so on.
std::vector<double> class_radii(const PlotParams& params);

// Throws `Error` (usage) for the first value out of range, shares over 1 in sum, and classes
// not in order; names begin with `path`.
void validate_plots(const PlotParams& params, const std::string& path);

}  // namespace talus
