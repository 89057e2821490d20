#include "talus/tools/deposit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "talus/base/parallel.h"
#include "talus/field/gradient_noise.h"

namespace talus {
namespace {

constexpr int kNoiseOctaves = 4;
constexpr double kNoiseContrast = 0.8;  // so that its usual values reach from none to full

// Where something dropped comes to lie.
struct Landing {
  Steps surface = 0;
  Steps air = 0;  // above it
  Material below = Material::bedrock;
  Steps thickness = 0;  // of the layer below
};

Landing land_on_top(std::span<const Layer> layers, Steps floor) {
  if (layers.empty()) return {.surface = floor, .air = kStepsMax - floor};
  const Steps top = layers.back().top();
  const Steps bottom = layers.size() > 1 ? layers[layers.size() - 2].top() : floor;
  return {top, kStepsMax - top, layers.back().material(), top - bottom};
}

// From a height; none from within bedrock.
std::optional<Landing> land_from(std::span<const Layer> layers, Steps floor, Steps z) {
  std::size_t i = 0;
  while (i < layers.size() && layers[i].top() <= z) ++i;
  if (z < floor || (i < layers.size() && layers[i].material() == Material::bedrock))
    return std::nullopt;
  // Out of loose matter upward, to air or a roof.
  const auto is_end = [](const Layer& layer) {
    return layer.material() == Material::air || layer.material() == Material::bedrock;
  };
  while (i < layers.size() && !is_end(layers[i])) ++i;
  Landing landing = land_on_top(layers.first(i), floor);
  if (i < layers.size())
    landing.air = layers[i].material() == Material::air ? layers[i].top() - landing.surface : 0;
  return landing;
}

// A surface of a column, with what it can take or give and the share of the height that it gets.
struct Spot {
  int x = 0;
  Steps surface = 0;
  Steps room = 0;
  double share = 0;
  Steps moved = 0;
};

// Heights over a square, from 0 for the lowest to 1 for the highest.
class Stamp {
 public:
  explicit Stamp(const HeightGrid& map) : map_(map) {
    const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
    low_ = *low;
    range_ = double{*high} - *low;
  }

  // At a place of the square [-1, 1] x [-1, 1]; beyond it 0.
  double at(const Vec2& p) const {
    if (std::max(std::abs(p.x), std::abs(p.y)) > 1) return 0;
    const double x = std::clamp(0.5 * (p.x + 1) * map_.nx - 0.5, 0.0, map_.nx - 1.0);
    const double y = std::clamp(0.5 * (p.y + 1) * map_.ny - 0.5, 0.0, map_.ny - 1.0);
    const int i = std::min(static_cast<int>(x), std::max(0, map_.nx - 2));
    const int j = std::min(static_cast<int>(y), std::max(0, map_.ny - 2));
    const auto row = [&](int r) {
      return std::lerp(height(i, r), height(std::min(i + 1, map_.nx - 1), r), x - i);
    };
    return (std::lerp(row(j), row(std::min(j + 1, map_.ny - 1)), y - j) - low_) / range_;
  }

 private:
  double height(int x, int y) const { return map_.heights[map_.index(x, y)]; }

  const HeightGrid& map_;
  double low_ = 0;
  double range_ = 1;
};

// What a dab lays at an offset from its middle, as a share of its height.
class Profile {
 public:
  Profile(const DepositParams& params, std::uint64_t seed)
      : profile_(params.profile), noise_size_(params.noise_size), noise_(seed) {
    if (profile_ == DepositProfile::map) stamp_.emplace(params.map);
  }

  double at(const Vec2& offset) const {
    if (stamp_) return stamp_->at(offset);
    const double squared = offset.x * offset.x + offset.y * offset.y;
    if (squared >= 1) return 0;
    switch (profile_) {
      case DepositProfile::constant:
        return 1;
      case DepositProfile::cone:
        return 1 - std::sqrt(squared);
      default:
        return 1 - squared;
    }
  }

  // What the place alone makes of it.
  double at_place(const Vec2& place) const {
    if (profile_ != DepositProfile::noise) return 1;
    const double n = fractal(noise_, place / noise_size_, {.octaves = kNoiseOctaves});
    return std::clamp(0.5 + kNoiseContrast * n, 0.0, 1.0);
  }

 private:
  DepositProfile profile_;
  double noise_size_;
  GradientNoise noise_;
  std::optional<Stamp> stamp_;
};

// A map needs heights to tell apart, and dabs to be stretched over.
void check_map(const HeightGrid& map, const BrushRegion& region) {
  if (region.points.empty())
    throw usage_error("deposit.profile is a map, which needs dabs; give points");
  const std::size_t cells =
      static_cast<std::size_t>(std::max(map.nx, 0)) * static_cast<std::size_t>(std::max(map.ny, 0));
  const std::vector<float>& heights = map.heights;
  const bool finite =
      std::all_of(heights.begin(), heights.end(), [](float h) { return std::isfinite(h); });
  const bool flat =
      std::all_of(heights.begin(), heights.end(), [&](float h) { return h == heights.front(); });
  if (heights.size() != cells || !finite || flat)
    throw usage_error("deposit.map must have known heights of which one is higher than another");
}

// All spots, row by row of the area; row y begins at `row_begin[y - area.y_begin]`.
struct Spots {
  std::vector<Spot> all;
  std::vector<std::size_t> row_begin;

  std::span<const Spot> of_column(const ColumnArea& area, int x, int y) const {
    const auto row = static_cast<std::size_t>(y - area.y_begin);
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row_begin[row]);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(row_begin[row + 1]);
    const auto found = std::ranges::equal_range(begin, end, x, {}, &Spot::x);
    return {found.begin(), found.end()};
  }
};

// Where what a brush drops comes to lie.
class SpotFinder {
 public:
  SpotFinder(const LayeredTerrain& terrain, const Brush& brush, const DepositParams& params,
             std::uint64_t seed)
      : terrain_(terrain), brush_(brush), params_(params), profile_(params, seed) {}

  Spots find(Job* job) const {
    const ColumnArea& area = brush_.area();
    std::vector<std::vector<Spot>> rows(
        static_cast<std::size_t>(std::max(0, area.y_end - area.y_begin)));
    parallel_for(rows.size(), [&](std::size_t row) {
      check_cancelled(job);
      for (int x = area.x_begin; x < area.x_end; ++x)
        add_column(x, area.y_begin + static_cast<int>(row), rows[row]);
    });
    Spots spots{.row_begin = {0}};
    for (const std::vector<Spot>& row : rows) {
      spots.all.insert(spots.all.end(), row.begin(), row.end());
      spots.row_begin.push_back(spots.all.size());
    }
    return spots;
  }

 private:
  void add_column(int x, int y, std::vector<Spot>& spots) const {
    const Vec2 axis = brush_.axis(x, y);
    const double share_here = brush_.mask(x, y) * profile_.at_place(axis);
    if (share_here == 0) return;
    const std::size_t begin = spots.size();
    const auto add = [&](const Landing& landing, double share) {
      for (std::size_t i = begin; i < spots.size(); ++i)
        if (spots[i].surface == landing.surface) {
          spots[i].share = std::max(spots[i].share, share);
          return;
        }
      const Steps given = landing.below == params_.material ? landing.thickness : 0;
      const Steps room = params_.remove ? given : landing.air;
      if (room > 0) spots.push_back({x, landing.surface, room, share});
    };

    const std::span<const Layer> layers = terrain_.column(x, y);
    const TerrainGrid& grid = terrain_.grid();
    const Landing top = land_on_top(layers, grid.floor);
    if (brush_.everywhere()) {
      add(top, share_here);
      return;
    }
    for (const SurfacePoint& dab : brush_.dabs_near(x, y)) {
      const double share = share_here * profile_.at((axis - dab.at) / brush_.radius());
      if (share == 0) continue;
      const auto landing =
          dab.z ? land_from(layers, grid.floor, grid.step_at(*dab.z)) : std::optional(top);
      if (landing) add(*landing, share);
    }
  }

  const LayeredTerrain& terrain_;
  const Brush& brush_;
  const DepositParams& params_;
  Profile profile_;
};

// Moves a number of steps in proportion to the spots' shares, at none more than it has room for;
// to the step, by largest remainder, or all there is room for.
void share_out(std::int64_t steps, std::vector<Spot>& spots) {
  // Those that fill up first come first; shares are summed from the last on.
  std::vector<Spot*> order;
  for (Spot& spot : spots) order.push_back(&spot);
  std::ranges::stable_sort(order, {}, [](const Spot* spot) { return spot->room / spot->share; });
  std::vector<double> shares(order.size() + 1);
  for (std::size_t i = order.size(); i-- > 0;) shares[i] = shares[i + 1] + order[i]->share;

  std::size_t i = 0;
  for (; i < order.size(); ++i) {
    Spot& spot = *order[i];
    if (static_cast<double>(steps) * spot.share < spot.room * shares[i]) break;
    spot.moved = static_cast<Steps>(std::min<std::int64_t>(spot.room, steps));
    steps -= spot.moved;
  }
  if (i == order.size()) return;

  // The rest have room for their part: whole steps, then one more for the largest remainders.
  const double per_share = static_cast<double>(steps) / shares[i];
  std::vector<std::pair<double, Spot*>> remainders;
  for (; i < order.size(); ++i) {
    Spot& spot = *order[i];
    const double part = per_share * spot.share;
    spot.moved = std::min(static_cast<Steps>(part), spot.room);
    steps -= spot.moved;
    remainders.emplace_back(part - spot.moved, &spot);
  }
  std::ranges::stable_sort(remainders, std::greater{}, &std::pair<double, Spot*>::first);
  for (const auto& [remainder, spot] : remainders)
    if (steps > 0 && spot->moved < spot->room) {
      ++spot->moved;
      --steps;
    }
}

}  // namespace

std::int64_t steps_of_volume(const TerrainGrid& grid, double volume) {
  constexpr double kMost = 1e18;
  return std::llround(std::min(volume / (grid.cell * grid.cell * grid.step), kMost));
}

void validate_deposit(const DepositParams& params) {
  validate(params, "deposit");
  if (params.material == Material::air)
    throw usage_error(
        "deposit: \"material\" is air; to take matter away, name it and write remove = true");
  if (params.height && params.volume)
    throw usage_error("deposit: \"height\" and \"volume\" are both given; leave one of them out");
  if (!params.height && !params.volume)
    throw usage_error(
        "deposit: how much is missing; write height = METRES or volume = CUBIC_METRES");
}

Booking deposit(LayeredTerrain& terrain, const BrushRegion& region, const DepositParams& params,
                std::uint64_t seed, Job* job) {
  validate_deposit(params);
  if (params.profile == DepositProfile::map) check_map(params.map, region);
  const Brush brush(terrain.grid(), region, params.brush, "deposit");
  Spots spots = SpotFinder(terrain, brush, params, seed).find(job);
  if (params.volume)
    share_out(steps_of_volume(terrain.grid(), *params.volume), spots.all);
  else
    for (Spot& spot : spots.all)
      spot.moved = terrain.nearest_step(*params.height * spot.share, spot.room);

  return terrain.edit(
      brush.area(),
      [&](int x, int y, ColumnEditor& column) {
        for (const Spot& spot : spots.of_column(brush.area(), x, y))
          if (params.remove)
            column.replace(spot.surface - spot.moved, spot.surface, Material::air);
          else
            column.replace(spot.surface, spot.surface + spot.moved, params.material);
      },
      job);
}

}  // namespace talus
