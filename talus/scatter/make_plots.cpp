#include "talus/scatter/make_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/scatter/choice.h"
#include "talus/scatter/sites.h"

namespace talus {
namespace {

using namespace scatter;

// Least distance between sites, in radii.
constexpr double kSpacing = 0.93;
// Mean area of cells, in squared distances: random throws leave no place once disks of half the
// distance fill 0.547 of the plane.
constexpr double kMeanCell = std::numbers::pi / 4 / 0.547;

// The shortest edge of a class's lattice, in distances: wide, so that little is thrown twice.
constexpr std::int64_t kLatticeEdge = 32;

// Edge of a block, at least, in radii of the largest class.
constexpr double kBlockRadii = 16;

// Least distance between sites, in steps, which rounding must not show in.
constexpr double kDistanceMin = 1000;

constexpr double kSitesMax = 3e7;    // of a class in a block
constexpr double kSitesPiece = 2e6;  // in a piece, about
constexpr double kPieceBlocks = 32;  // along a piece's edge, at most

// The lattice of a class has at most so many squares along a block, whose edge they divide.
constexpr std::int64_t kSquaresMax = 4096;

// The grid of a pattern. Its step is a power of two of a metre, 2^-26 of a block or a little more,
// so that coordinates in metres are exact.
struct Frame {
  double step = 0;  // m
  std::int64_t block_steps = 0;
  Vec2 origin{0};
  std::optional<Rect> bounds;  // in block (0, 0), the only one

  explicit Frame(double block_size)
      : step(std::ldexp(1, std::ilogb(block_size) - 25)),
        block_steps(kSquaresMax * static_cast<std::int64_t>(std::ceil(
                                      block_size / step / static_cast<double>(kSquaresMax)))) {}

  Vec2 metres(const Point& p) const { return origin + step * Vec2(p.x, p.y); }
  double area(std::int64_t twice_steps) const {
    return 0.5 * static_cast<double>(twice_steps) * step * step;
  }
  std::int64_t twice_block_area() const {
    return 2 * (bounds ? bounds->hi.x * bounds->hi.y : block_steps * block_steps);
  }
  // Points whose metres are at least the lower and less than the upper bounds.
  Rect steps(const Box2& box) const {
    const auto first = [&](double x) { return static_cast<std::int64_t>(std::ceil(x / step)); };
    return {{first(box.min.x), first(box.min.y)}, {first(box.max.x), first(box.max.y)}};
  }
  Rect blocks(const Rect& r) const {
    const auto block = [&](std::int64_t x) { return floor_div(x, block_steps); };
    return {{block(r.lo.x), block(r.lo.y)}, {block(r.hi.x - 1) + 1, block(r.hi.y - 1) + 1}};
  }
};

// One class with its share of a block's area, or of it all together with the larger classes.
struct ClassPlan {
  double radius = 0;
  SiteLattice lattice;
  std::int64_t squares = 1;  // of the lattice, along a block
  std::optional<std::int64_t> twice_area;
  std::optional<std::int64_t> twice_area_of_all;
  std::optional<int> count;

  Fit fit() const { return twice_area_of_all ? Fit::cut : Fit::whole; }
  // Twice the area asked in a block; none for a class that is counted.
  std::optional<std::int64_t> asked(std::int64_t twice_area_covered) const {
    if (!twice_area_of_all) return twice_area;
    return std::max<std::int64_t>(0, *twice_area_of_all - twice_area_covered);
  }
};

std::vector<ClassPlan> plan_classes(const PlotParams& params, std::uint64_t seed,
                                    const Frame& frame) {
  const auto part = [&](double share) {
    return std::llround(share * static_cast<double>(frame.twice_block_area()));
  };
  std::vector<ClassPlan> plans;
  for (const double radius : class_radii(params)) {
    const std::size_t k = plans.size();
    ClassPlan plan{.radius = radius};
    if (k >= params.classes.size())
      plan.twice_area_of_all = part(params.gaps->coverage);
    else if (params.classes[k].count)
      plan.count = params.classes[k].count;
    else
      plan.twice_area = part(params.classes[k].area_share);

    plan.lattice.key = hash(seed, Purpose::scatter_sites, k);
    plan.lattice.distance = static_cast<std::int64_t>(std::ceil(kSpacing * radius / frame.step));
    plan.lattice.bounds = frame.bounds;
    while (plan.squares < kSquaresMax &&
           frame.block_steps >= 2 * plan.squares * kLatticeEdge * plan.lattice.distance)
      plan.squares *= 2;
    plan.lattice.edge = frame.block_steps / plan.squares;
    plans.push_back(plan);
  }
  return plans;
}

// The plots of blocks, made from the largest class to the smallest.
class PlotMaker {
 public:
  PlotMaker(const PlotParams& params, std::uint64_t seed, const Frame& frame, Job* job)
      : seed_(seed), frame_(frame), job_(job), plans_(plan_classes(params, seed, frame)) {}

  // Those whose sites lie in the region.
  PlotResult make(const Rect& region) {
    const Rect blocks = frame_.blocks(region);
    const auto classes = static_cast<std::int64_t>(plans_.size());
    PlotResult result{.report = report_of(blocks)};
    // What a class leaves out depends on larger classes of the blocks around.
    const auto around = [&](std::int64_t k) {
      return frame_.bounds ? blocks : blocks.expanded(classes - 1 - k);
    };
    RectGrid<std::int64_t> covered(around(0));  // twice the area
    for (std::int64_t k = 0; k < classes; ++k) {
      const ClassPlan& plan = plans_[static_cast<std::size_t>(k)];
      const SiteSet sites = sites_of(plan, around(k), covered);
      RectGrid<Choice> choices = choose(static_cast<std::size_t>(k), sites, around(k), covered);
      result.report.classes.push_back(report_of(plan, choices, covered, blocks));
      keep(std::move(choices), sites, covered);
      report_progress(job_, "plots", static_cast<double>(k + 1) / static_cast<double>(classes));
    }
    for (std::size_t k = 0; k < plans_.size(); ++k) add_plots(k, region, result.plots);
    return result;
  }

 private:
  // None where all blocks have enough.
  SiteSet sites_of(const ClassPlan& plan, const Rect& blocks,
                   const RectGrid<std::int64_t>& covered) const {
    bool wanted = false;
    covered.for_each([&](const Point& block, std::int64_t area) {
      wanted = wanted || (blocks.contains(block) && goal_of(plan, area).twice_area > 0);
    });
    if (!wanted) return SiteSet({}, plan.lattice.distance);
    const std::int64_t n = plan.squares, edge = plan.lattice.edge;
    if (frame_.bounds) {
      const auto& [x, y] = frame_.bounds->hi;
      return make_sites(plan.lattice, {{0, 0}, {(x + edge - 1) / edge, (y + edge - 1) / edge}},
                        job_);
    }
    const Rect squares{{blocks.lo.x * n, blocks.lo.y * n}, {blocks.hi.x * n, blocks.hi.y * n}};
    return make_sites(plan.lattice, squares.expanded(1), job_);
  }

  RectGrid<Choice> choose(std::size_t k, const SiteSet& sites, const Rect& blocks,
                          const RectGrid<std::int64_t>& covered) const {
    RectGrid<std::vector<Candidate>> candidates(blocks);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const auto& [x, y] = sites[i];
      const Point block{floor_div(x, frame_.block_steps), floor_div(y, frame_.block_steps)};
      if (blocks.contains(block))
        candidates.at(block).push_back({i, hash(seed_, Purpose::scatter_plot, k, x, y)});
    }
    RectGrid<Choice> choices(blocks);
    choices.parallel_for_each([&](const Point& block, Choice& choice) {
      check_cancelled(job_);
      choice = choose_cells(sites, frame_.bounds, std::move(candidates.at(block)), chosen_,
                            plans_[k].fit(), goal_of(plans_[k], covered.at(block)));
    });
    return choices;
  }

  Goal goal_of(const ClassPlan& plan, std::int64_t twice_area_covered) const {
    const auto asked = plan.asked(twice_area_covered);
    if (!asked) return {.count = static_cast<std::size_t>(*plan.count)};
    if (*asked >= frame_.twice_block_area()) return {};  // every cell, whatever their sum
    // For less than half a cell a block takes none, whether or not others have this class.
    const auto d = static_cast<double>(plan.lattice.distance);
    const bool too_little = static_cast<double>(*asked) < kMeanCell * d * d;
    return {.twice_area = too_little ? 0 : *asked};
  }

  PlotReport report_of(const Rect& blocks) const {
    const auto count =
        static_cast<std::uint64_t>((blocks.hi.x - blocks.lo.x) * (blocks.hi.y - blocks.lo.y));
    return {.blocks = count,
            .area = static_cast<double>(count) * frame_.area(frame_.twice_block_area())};
  }
  ClassReport report_of(const ClassPlan& plan, const RectGrid<Choice>& choices,
                        const RectGrid<std::int64_t>& covered, const Rect& blocks) const {
    ClassReport report{.radius = plan.radius};
    double asked_area = 0;
    choices.for_each([&](const Point& block, const Choice& choice) {
      if (!blocks.contains(block)) return;
      report.area += frame_.area(choice.twice_area);
      const auto asked = plan.asked(covered.at(block));
      if (asked) asked_area += frame_.area(*asked);
      const bool enough = asked ? choice.twice_area >= *asked
                                : choice.cells.size() == static_cast<std::size_t>(*plan.count);
      report.full_blocks += choice.exhausted && !enough;
      report.plots += choice.cells.size();
      report.sites += choice.candidates;
    });
    if (!plan.count) report.asked_area = asked_area;
    report.expected_sites =
        0.7 * report_of(blocks).area / (std::numbers::pi * 0.25 * plan.radius * plan.radius);
    return report;
  }

  void keep(RectGrid<Choice>&& choices, const SiteSet& sites, RectGrid<std::int64_t>& covered) {
    ChosenCells kept{.sites = SiteSet(sites.area(), sites.distance())};
    choices.for_each([&](const Point& block, Choice& choice) {
      covered.at(block) += choice.twice_area;
      for (Cell& cell : choice.cells) {
        kept.sites.insert(cell.site);
        kept.cells.push_back(std::move(cell));
      }
      kept.keys.insert(kept.keys.end(), choice.keys.begin(), choice.keys.end());
    });
    chosen_.push_back(std::move(kept));
  }

  void add_plots(std::size_t k, const Rect& region, Plots& plots) const {
    const ChosenCells& chosen = chosen_[k];
    for (std::size_t i = 0; i < chosen.cells.size(); ++i) {
      const Cell& cell = chosen.cells[i];
      if (!region.contains(cell.site)) continue;
      plots.plots.push_back({.site = frame_.metres(cell.site),
                             .key = chosen.keys[i],
                             .first_corner = static_cast<std::uint32_t>(plots.corners.size()),
                             .corner_count = static_cast<std::uint16_t>(cell.corners.size()),
                             .size_class = static_cast<std::uint16_t>(k)});
      for (const Point& corner : cell.corners)
        plots.corners.push_back(frame_.metres({cell.site.x + corner.x, cell.site.y + corner.y}));
    }
  }

  std::uint64_t seed_;
  Frame frame_;
  Job* job_;
  std::vector<ClassPlan> plans_;
  std::vector<ChosenCells> chosen_;  // of the classes done
};

double mean_cell_area(double radius) {
  const double distance = kSpacing * radius;
  return kMeanCell * distance * distance;
}

// In a block.
double expected_sites(double radius, const Frame& frame) {
  return frame.area(frame.twice_block_area()) / mean_cell_area(radius);
}

// Whether the smallest stones of a block can be told from its grid, and held in memory.
void check_sizes(const PlotParams& params, const Frame& frame) {
  const double smallest = class_radii(params).back();
  const double sites = expected_sites(smallest, frame);
  const double least =
      std::max(smallest * std::sqrt(sites / kSitesMax), kDistanceMin * frame.step / kSpacing);
  if (smallest >= least) return;
  throw job_error(
      fmt::format("scatter: stones of radius {} m are {:.2g} in a block of {:.6g} m; radii of "
                  "{:.2g} m and more can be made",
                  smallest, sites, static_cast<double>(frame.block_steps) * frame.step, least));
}

// Of the whole pattern, after looking through the params.
Frame endless_frame(const PlotParams& params) {
  validate_plots(params, "scatter");
  const double least = kBlockRadii * params.classes.front().radius;
  if (params.block_size && *params.block_size < least)
    throw usage_error(
        fmt::format("scatter.block_size = {} m must be at least {} m, {} radii of the "
                    "largest stones",
                    *params.block_size, least, kBlockRadii));
  for (std::size_t k = 0; k < params.classes.size(); ++k)
    if (params.classes[k].count)
      throw usage_error(
          fmt::format("scatter.classes[{}].count is for bounded ground; give area_share", k));
  const Frame frame(params.block_size.value_or(least));
  check_sizes(params, frame);
  return frame;
}

Rect region_steps(const Frame& frame, const Box2& region) {
  const double farthest = std::max({std::abs(region.min.x), std::abs(region.min.y),
                                    std::abs(region.max.x), std::abs(region.max.y)});
  const Vec2 size = region.size();
  if (!(size.x > 0 && size.y > 0 && std::isfinite(farthest)))
    throw usage_error(fmt::format("scatter: the region ({}, {}) to ({}, {}) m has no area",
                                  region.min.x, region.min.y, region.max.x, region.max.y));
  if (const double limit = 0x1p52 * frame.step; farthest > limit)
    throw usage_error(
        fmt::format("scatter: the region reaches out to {:.6g} m; stones of this size "
                    "can lie within {:.6g} m of (0, 0)",
                    farthest, limit));
  return frame.steps(region);
}

}  // namespace

double PlotReport::coverage() const {
  double covered = 0;
  for (const ClassReport& report : classes) covered += report.area;
  return covered / area;
}

void PlotReport::add(const PlotReport& other) {
  if (classes.empty()) classes.resize(other.classes.size());
  blocks += other.blocks;
  area += other.area;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    ClassReport& to = classes[k];
    const ClassReport& from = other.classes[k];
    to.radius = from.radius;
    to.area += from.area;
    if (from.asked_area) to.asked_area = to.asked_area.value_or(0) + *from.asked_area;
    to.plots += from.plots;
    to.sites += from.sites;
    to.expected_sites += from.expected_sites;
    to.full_blocks += from.full_blocks;
  }
}

PlotResult make_plots(const PlotParams& params, std::uint64_t seed, const Box2& region, Job* job) {
  const Frame frame = endless_frame(params);
  return PlotMaker(params, seed, frame, job).make(region_steps(frame, region));
}

PlotResult make_bounded_plots(const PlotParams& params, std::uint64_t seed, const Box2& bounds,
                              Job* job) {
  validate_plots(params, "scatter");
  const Vec2 size = bounds.size();
  const double radius = params.classes.front().radius;
  if (!(size.x > 0 && size.y > 0 && std::isfinite(size.x + size.y)))
    throw usage_error(
        fmt::format("scatter: the ground of {} m x {} m has no area", size.x, size.y));
  if (radius > std::min(size.x, size.y))
    throw usage_error(
        fmt::format("scatter.classes[0].radius = {} m is larger than the ground of {} "
                    "m x {} m; it may be {} m at most",
                    radius, size.x, size.y, std::min(size.x, size.y)));
  Frame frame(std::max(size.x, size.y));
  frame.origin = bounds.min;
  frame.bounds = Rect{{0, 0},
                      {static_cast<std::int64_t>(size.x / frame.step),
                       static_cast<std::int64_t>(size.y / frame.step)}};
  check_sizes(params, frame);
  return PlotMaker(params, seed, frame, job).make(*frame.bounds);
}

std::vector<Box2> cut_into_pieces(const PlotParams& params, const Box2& region) {
  const Frame frame = endless_frame(params);
  const Rect blocks = frame.blocks(region_steps(frame, region));
  double sites = 0;  // of a block
  for (const double radius : class_radii(params)) sites += expected_sites(radius, frame);
  const auto edge = static_cast<std::int64_t>(
      std::clamp(std::floor(std::sqrt(kSitesPiece / sites)), 1.0, kPieceBlocks));

  std::vector<Box2> pieces;
  for (std::int64_t y = blocks.lo.y; y < blocks.hi.y; y += edge)
    for (std::int64_t x = blocks.lo.x; x < blocks.hi.x; x += edge) {
      const std::int64_t b = frame.block_steps;
      const Box2 piece{frame.metres({x * b, y * b}),
                       frame.metres({(x + edge) * b, (y + edge) * b})};
      pieces.push_back({glm::max(piece.min, region.min), glm::min(piece.max, region.max)});
    }
  return pieces;
}

double expected_plots(const PlotParams& params, double area) {
  double plots = 0, covered = 0;
  for (const SizeClass& size : params.classes) {
    const double number =
        size.count ? *size.count : size.area_share * area / mean_cell_area(size.radius);
    plots += number;
    covered += number * mean_cell_area(size.radius);
  }
  if (!params.gaps) return plots;
  // Most of what fills gaps is of the first size, cut to two thirds.
  const double free = std::max(0.0, params.gaps->coverage * area - covered);
  return plots + free / (0.67 * mean_cell_area(0.5 * params.classes.back().radius));
}

}  // namespace talus
