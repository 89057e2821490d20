#include "talus/rocks/seed_places.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "talus/base/cube_root.h"
#include "talus/rocks/draws.h"

namespace talus::rocks {
namespace {

// Points that are thrown one after another and stay where they are this far from all others leave
// no room for more at about one in a unit of volume [Zhang2013].
constexpr double kSaturatedSpacing = 0.90;

int count_seeds(const TileParams& params, std::uint64_t key) {
  const int spread = params.seeds_max - params.seeds_min + 1;
  return params.seeds_min + static_cast<int>(uniform(key) * spread);
}

// Few seeds keep to the middle three quarters of each edge, which keeps stones compact and away
// from seeds that they cannot know of.
Vec3 into_cell(const Vec3& u, int count) { return count < 4 ? 0.125 + 0.75 * u : u; }

// The additive recurrence on the generalised golden ratio with a random start [Roberts2018].
std::vector<Vec3> spread_evenly(int count, Draws& draws) {
  constexpr double kRatio = 1.2207440846057596;  // the real root of x^4 = x + 1
  const Vec3 step(1 / kRatio, 1 / (kRatio * kRatio), 1 / (kRatio * kRatio * kRatio));
  const Vec3 start = draws.next_point();
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k)
    places.push_back(into_cell(glm::fract(start + static_cast<double>(k) * step), count));
  return places;
}

// A cell and the colors it depends on.
struct Key {
  Int3 cell;
  std::uint32_t code;
};

// Relaxed dart throwing [McCool1992], cell by cell: a seed keeps a distance from those of the cells
// around it that were made before, as far as its own colors tell which these are; the distance
// shrinks with every dart that misses.
class DartThrower {
 public:
  DartThrower(const TileParams& params, std::uint64_t seed)
      : params_(params),
        layout_(params),
        seed_(seed),
        spacing_(kSaturatedSpacing / cube_root(0.5 * (params.seeds_min + params.seeds_max))) {
    first_key_.push_back(0);
    for (std::size_t c = 0; c < layout_.cell_count(); ++c) {
      const CornerBox corners = layout_.seed_corners(layout_.cell_at(c));
      for (std::uint32_t code = 0; code < code_count(corners, layout_.colors); ++code)
        keys_.push_back({layout_.cell_at(c), code});
      first_key_.push_back(keys_.size());
    }
    places_.resize(keys_.size());
  }

  // Cells that depend on few corners first: those around them know them.
  std::vector<std::vector<Vec3>> throw_cell_by_cell() {
    std::vector<std::size_t> order(keys_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return corner_count(keys_[a].cell) < corner_count(keys_[b].cell);
    });
    for (const std::size_t i : order) {
      const std::uint64_t key = seed_key(seed_, keys_[i].cell, keys_[i].code);
      const int count = count_seeds(params_, key);
      std::vector<Vec3> taken = known_around(keys_[i]);
      Draws draws(seed_, Purpose::seed_position, key);
      constexpr double kShrink = 0.98;
      for (double spacing = spacing_; std::ssize(places_[i]) < count;) {
        const Vec3 dart = into_cell(draws.next_point(), count);
        if (is_free(dart, taken, spacing)) {
          taken.push_back(dart);
          places_[i].push_back(dart);
        } else {
          spacing *= kShrink;
        }
      }
    }
    return std::move(places_);
  }

  // The same for a cube that is its own neighbor: all its seeds know of each other.
  std::vector<std::vector<Vec3>> throw_everywhere() {
    int wanted = 0;
    for (const Key& key : keys_) wanted += count_seeds(params_, seed_key(seed_, key.cell, 0));
    Draws draws(seed_, Purpose::seed_position, 0);
    const double shrink = 1 - 1e-3 / wanted;
    const double edge = layout_.period();
    double spacing = kSaturatedSpacing * cube_root(edge * edge * edge / wanted);
    for (int placed = 0; placed < wanted;) {
      const Vec3 dart = edge * draws.next_point();
      const Int3 cell = glm::min(Int3(dart), Int3(layout_.period() - 1));
      if (is_free(dart - Vec3(cell), around_in_torus(cell), spacing)) {
        places_[layout_.cell_index(cell)].push_back(dart - Vec3(cell));
        ++placed;
      } else {
        spacing *= shrink;
      }
    }
    return std::move(places_);
  }

 private:
  int corner_count(const Int3& cell) const { return layout_.seed_corners(cell).corners(); }

  static bool is_free(const Vec3& dart, const std::vector<Vec3>& taken, double spacing) {
    return std::none_of(taken.begin(), taken.end(), [&](const Vec3& t) {
      const Vec3 d = t - dart;
      return glm::dot(d, d) < spacing * spacing;
    });
  }

  // Calls `use(step, local cell, cube)` for the 26 cells around one.
  void for_each_neighbor(const Int3& cell, auto&& use) const {
    for (int i = 0; i < 27; ++i) {
      const Int3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      Int3 cube;
      for (int axis = 0; axis < 3; ++axis)
        cube[axis] = floor_div(cell[axis] + step[axis], layout_.period());
      if (step != Int3(0)) use(step, cell + step - layout_.period() * cube, cube);
    }
  }

  // Seeds around a cell that depend on no corner that it does not depend on; those of cells not yet
  // made are none.
  std::vector<Vec3> known_around(const Key& key) const {
    const CornerBox own = layout_.seed_corners(key.cell);
    std::vector<Vec3> known;
    for_each_neighbor(key.cell, [&](const Int3& step, const Int3& local, const Int3& cube) {
      const CornerBox its = layout_.seed_corners(local);
      const Int3 first = layout_.colored_corner(its.first + cube), last = first + its.count - 1;
      for (int axis = 0; axis < 3; ++axis)
        if (first[axis] < own.first[axis] || last[axis] >= own.first[axis] + own.count[axis])
          return;
      const std::uint32_t code = color_code(its, layout_.colors, [&](const Int3& corner) {
        return decode_color(own, layout_.colors, key.code, layout_.colored_corner(corner + cube));
      });
      for (const Vec3& place : places_[first_key_[layout_.cell_index(local)] + code])
        known.push_back(place + Vec3(step));
    });
    return known;
  }

  std::vector<Vec3> around_in_torus(const Int3& cell) const {
    std::vector<Vec3> known = places_[layout_.cell_index(cell)];
    for_each_neighbor(cell, [&](const Int3& step, const Int3& local, const Int3&) {
      for (const Vec3& place : places_[layout_.cell_index(local)])
        known.push_back(place + Vec3(step));
    });
    return known;
  }

  TileParams params_;
  CellLayout layout_;
  std::uint64_t seed_;
  double spacing_;
  std::vector<Key> keys_;
  std::vector<std::size_t> first_key_;  // per cell; their number last
  std::vector<std::vector<Vec3>> places_;
};

}  // namespace

std::uint64_t seed_key(std::uint64_t seed, const Int3& cell, std::uint32_t code) {
  return hash(seed, Purpose::seed_count, cell.x, cell.y, cell.z, code);
}

std::vector<std::vector<Vec3>> place_seeds(const TileParams& params, std::uint64_t seed) {
  if (params.placement == SeedPlacement::poisson) {
    DartThrower thrower(params, seed);
    return params.variety == Variety::periodic ? thrower.throw_everywhere()
                                               : thrower.throw_cell_by_cell();
  }
  const CellLayout layout(params);
  std::vector<std::vector<Vec3>> places;
  for (std::size_t c = 0; c < layout.cell_count(); ++c) {
    const Int3 cell = layout.cell_at(c);
    const std::uint32_t codes = code_count(layout.seed_corners(cell), layout.colors);
    for (std::uint32_t code = 0; code < codes; ++code) {
      const std::uint64_t key = seed_key(seed, cell, code);
      Draws draws(seed, Purpose::seed_position, key);
      places.push_back(spread_evenly(count_seeds(params, key), draws));
    }
  }
  return places;
}

}  // namespace talus::rocks
