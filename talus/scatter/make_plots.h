// Ground divided into plots: cells of several Voronoi diagrams, one for each size, chosen so that
// none overlap ([Sakurai2010] sections 3.1 and 3.2).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "talus/base/job.h"
#include "talus/scatter/plot_params.h"
#include "talus/scatter/plots.h"

namespace talus {

// What became of one size class in the blocks that a call looked at, whole ones, also where they
// reach beyond its region.
struct ClassReport {
  double radius = 0;
  double area = 0;                   // of its plots, square metres
  std::optional<double> asked_area;  // none for a class that is counted
  std::uint64_t plots = 0;
  std::uint64_t sites = 0;
  double expected_sites = 0;  // [Sakurai2010] eq. 1, with c_d = 0.7
  std::uint64_t full_blocks =
      0;  // where no further cell fits, although less was reached than asked
};

struct PlotReport {
  std::uint64_t blocks = 0;
  double area = 0;                   // of the blocks, or of the bounded ground, square metres
  std::vector<ClassReport> classes;  // then those that fill gaps; as `class_radii`

  // Share of the area that plots cover.
  double coverage() const;
  // Joins what is said of other blocks, for the same params.
  void add(const PlotReport& other);
};

struct PlotResult {
  Plots plots;
  PlotReport report;
};

// The plots whose sites lie in the region, from its lower bounds up to, but without, the upper, of
// a pattern that covers the plane and is a function of place: any region can be made alone, and
// regions fit.
//
// Each class has a maximal Poisson-disk set of sites, 0.93 radius apart at least, and their Voronoi
// cells. In each square block, cells of a class come in an order drawn by place; those that would
// overlap a cell of a larger class, of this or another block, are passed over, until the class's
// share of the block's area is met within half a cell or no cell is left. With `gaps`, cells of
// ever smaller classes are cut along those they would overlap, until the coverage is met. The
// distance is what gives the counts of sites that the paper's figures show: its radius as printed
// leaves no place at 87 % of them, half of it ends with sites as uneven as chance.
//
// Throws `Error` (usage) for params out of range, counted classes, and regions that are empty or
// farther out than the pattern resolves; (job) for radii so small beside a block that
// memory would not hold its sites.
PlotResult make_plots(const PlotParams& params, std::uint64_t seed, const Box2& region,
                      Job* job = nullptr);

// The same on ground that ends: one block, with cells cut at its bounds. Its pattern is the
// bounds' own. Throws `Error` (usage) also for a radius larger than the ground's shorter side.
PlotResult make_bounded_plots(const PlotParams& params, std::uint64_t seed, const Box2& bounds,
                              Job* job = nullptr);

// The region cut along blocks into pieces that `make_plots` makes in little memory, in rows.
// Joined, their plots are the region's.
std::vector<Box2> cut_into_pieces(const PlotParams& params, const Box2& region);

// About how many plots an area has, square metres, if every class reaches its share.
double expected_plots(const PlotParams& params, double area);

}  // namespace talus
