#include "talus/scatter/choice.h"

#include <algorithm>
#include <numbers>
#include <tuple>
#include <utility>

#include "talus/base/parallel.h"

namespace talus::scatter {
namespace {

// Cells looked at together.
constexpr std::size_t kBatch = 256;

// Whether `pred(cell)` holds for a larger cell that may reach to one around a site.
template <class Predicate>
bool any_near(const std::vector<ChosenCells>& larger, const Point& site, std::int64_t distance,
              Predicate&& pred) {
  return std::any_of(larger.begin(), larger.end(), [&](const ChosenCells& chosen) {
    // Cells reach less than their distance from their sites.
    const std::int64_t reach = distance + chosen.sites.distance();
    return chosen.sites.any_near(Rect{site, site}.expanded(reach), [&](std::size_t i) {
      return squared_distance(chosen.sites[i], site) < reach * reach && pred(chosen.cells[i]);
    });
  });
}

// Of what is left of a cut cell: its area as a share of the square of the distance, whole cells
// having 1.44 in the mean, and its area beside that of a disk with its perimeter, which is 0.6 for
// a rectangle of 3 : 1.
constexpr double kCutAreaMin = 0.45;
constexpr double kCutRoundnessMin = 0.6;

bool stone_like(const Cell& cell, std::int64_t distance) {
  const double d = static_cast<double>(distance), border = perimeter(cell);
  const double area = 0.5 * static_cast<double>(twice_area(cell));
  return area >= kCutAreaMin * d * d &&
         4 * std::numbers::pi * area >= kCutRoundnessMin * border * border;
}

// Cut along the edges of the larger cells that it meets; none if too little is left.
std::optional<Cell> cut_cell(Cell cell, std::int64_t distance,
                             const std::vector<ChosenCells>& larger) {
  std::vector<const Cell*> others;
  any_near(larger, cell.site, distance, [&](const Cell& other) {
    if (cells_meet(cell, other)) others.push_back(&other);
    return false;
  });
  if (others.empty()) return cell;
  // In an order that does not depend on the sets.
  std::sort(others.begin(), others.end(),
            [](const Cell* a, const Cell* b) { return by_place(a->site, b->site); });
  std::optional<Cell> rest = std::move(cell);
  for (const Cell* other : others)
    if (rest && cells_meet(*rest, *other)) rest = cut_off(*rest, *other);
  if (rest && stone_like(*rest, distance)) return rest;
  return {};
}

// None if it does not fit.
std::optional<Cell> fitting_cell(const SiteSet& sites, std::size_t site,
                                 const std::optional<Rect>& bounds,
                                 const std::vector<ChosenCells>& larger, Fit fit) {
  const Point& p = sites[site];
  const std::int64_t d = sites.distance();
  if (any_near(larger, p, 0, [&](const Cell& other) { return inside(other, p); })) return {};
  std::optional<Cell> cell = voronoi_cell(sites, site, bounds);
  if (fit == Fit::cut) cell = cut_cell(*std::move(cell), d, larger);
  if (cell && any_near(larger, p, d, [&](const Cell& other) { return cells_meet(*cell, other); }))
    return {};
  return cell;
}

}  // namespace

Choice choose_cells(const SiteSet& sites, const std::optional<Rect>& bounds,
                    std::vector<Candidate> candidates, const std::vector<ChosenCells>& larger,
                    Fit fit, const Goal& goal) {
  Choice choice{.candidates = candidates.size()};
  if (goal.twice_area == 0) return choice;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.key, a.site) < std::tie(b.key, b.site);
  });
  std::vector<std::optional<Cell>> fitting;
  for (std::size_t first = 0; first < candidates.size(); first += kBatch) {
    // Cells of one class never meet, so that each fits or not whatever is taken before it.
    fitting.assign(std::min(kBatch, candidates.size() - first), {});
    parallel_for(
        fitting.size(),
        [&](std::size_t i) {
          fitting[i] = fitting_cell(sites, candidates[first + i].site, bounds, larger, fit);
        },
        32);
    for (std::size_t i = 0; i < fitting.size(); ++i) {
      if (!fitting[i]) continue;
      const std::int64_t area = twice_area(*fitting[i]);
      if (choice.cells.size() >= goal.count || choice.twice_area + area / 2 > goal.twice_area)
        return choice;
      choice.cells.push_back(*std::move(fitting[i]));
      choice.keys.push_back(candidates[first + i].key);
      choice.twice_area += area;
    }
  }
  choice.exhausted = true;
  return choice;
}

}  // namespace talus::scatter
