#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>

#include "talus/base/angle.h"
#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/piles/choice.h"
#include "talus/piles/cube_survey.h"
#include "talus/piles/neighborhood.h"
#include "talus/piles/pile.h"
#include "talus/piles/pile_edits.h"

namespace talus {
namespace {

using piles::ChoiceRule;
using piles::CubeChooser;
using piles::CubeExtent;
using piles::CubeStones;
using piles::CubeSurvey;
using piles::Neighborhood;

constexpr std::size_t kGrain = 8;        // cubes to a task
constexpr double kEndless = 4e9;         // m: no place is farther than 1e9 from the origin
constexpr double kMostCubesAlong = 1e8;  // so that cells have coordinates

// Without a place given, the tiling starts at the lower corner of the bounds as it sees them.
Tiling tiling_of(const Box3& bounds, const PileParams& params) {
  Tiling tiling{.turn = rotation_deg(params.tiling.rotate_deg),
                .cell_size = params.stone_size.in_metres(bounds.longest_side())};
  const Tiling back{.turn = glm::transpose(tiling.turn)};
  tiling.origin = params.tiling.at.value_or(tiling.turn * back.world(bounds).min);
  return tiling;
}

// Edits reach beyond the bounds.
CubeBox with_edits(CubeBox cubes, const PileControl& control, int period) {
  const auto include = [&](const StoneId& stone) {
    const Int3 cube = piles::cube_of(stone.cell, period);
    const Int3 last = glm::max(cubes.first + cubes.size - 1, cube);
    cubes.first = glm::min(cubes.first, cube);
    cubes.size = last + 1 - cubes.first;
  };
  for (const StoneId& stone : control.locked) include(stone);
  for (const StoneMove& move : control.moved) include(move.stone);
  return cubes;
}

CubeBox cubes_of(const Box3& bounds, const Tiling& tiling, const TileSet& tiles) {
  const CubeExtent extent = piles::cubes_around(bounds, tiling, tiles);
  const Vec3 last = glm::max(glm::abs(extent.first), glm::abs(extent.first + extent.size));
  if (!(std::max({last.x, last.y, last.z}) <= kMostCubesAlong && bounds.longest_side() <= kEndless))
    throw usage_error(fmt::format(
        "the pile would reach {:.2g} cells of stone_size = {:.3g} m from its tiling's origin; give "
        "a support with an end, larger stones, or a nearer tiling.at",
        (tiles.params().n - 1) * std::max({last.x, last.y, last.z}), tiling.cell_size));
  return {Int3(extent.first), Int3(extent.size)};
}

double density_at(const PileParams& params, const PileControl& control, const Vec3& p) {
  if (!control.density) return params.density;
  const DensityMask& mask = *control.density;
  const Vec2 at = (Vec2(p) - mask.area.min) / mask.area.size() * Vec2(mask.nx, mask.ny);
  if (!(at.x >= 0 && at.y >= 0 && at.x < mask.nx && at.y < mask.ny)) return 0;
  const int pixel = static_cast<int>(at.x) + mask.nx * static_cast<int>(at.y);
  return params.density * double{mask.shares[static_cast<std::size_t>(pixel)]};
}

void check(const DensityMask& mask) {
  if (mask.nx < 1 || mask.ny < 1 ||
      mask.shares.size() != static_cast<std::size_t>(mask.nx) * static_cast<std::size_t>(mask.ny))
    throw usage_error(fmt::format("pile.density: {} shares for a mask of {} x {}",
                                  mask.shares.size(), mask.nx, mask.ny));
  if (!(mask.area.size().x > 0 && mask.area.size().y > 0))
    throw usage_error("pile.density: the mask covers no area");
}

}  // namespace

struct PileFiller::Impl {
  Impl(const Support& support, std::shared_ptr<const TileSet> tile_set,
       const PileParams& pile_params, const PileControl& pile_control)
      : tiles(std::move(tile_set)),
        params(pile_params),
        control(pile_control),
        bounds(support.bounds()),
        tiling(tiling_of(bounds, params)),
        cubes(with_edits(cubes_of(bounds, tiling, *tiles), control, tiles->params().n - 1)),
        rule(piles::make_rule(support, control.keep_out, *tiles, params, tiling)) {}

  std::size_t words() const { return piles::words_per_cube(*tiles); }
  bool is_thinned() const { return params.density < 1 || control.density; }
  bool is_kept(const Int3& cell, std::uint32_t stone) const;

  std::vector<Int3> survey(const CubeBox& part) const;
  CubeBits choose(const std::vector<Int3>& surveyed, const CubeBox& part, PileStats& stats,
                  Job* job) const;
  void leave_out(const CubeBits& chosen, const CubeBox& part, Pile& pile, Job* job) const;
  void edit(const CubeBox& part, Pile& pile) const;

  std::shared_ptr<const TileSet> tiles;
  PileParams params;
  PileControl control;
  Box3 bounds;
  Tiling tiling;
  CubeBox cubes;
  ChoiceRule rule;
};

bool PileFiller::Impl::is_kept(const Int3& cell, std::uint32_t stone) const {
  const Stone& s = tiles->stones()[stone];
  const double density = density_at(params, control, tiling.world(Vec3(cell) + s.pivot));
  return uniform(hash(tiles->seed(), Purpose::pile_density, cell.x, cell.y, cell.z, s.seed)) <
         density;
}

// The cubes that can have stones: of the part, and around it, where its stones' neighbors are.
std::vector<Int3> PileFiller::Impl::survey(const CubeBox& part) const {
  const CubeBox wide = part.expanded(1);
  CubeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.first[axis] = std::max(wide.first[axis], cubes.first[axis]);
    box.size[axis] = std::max(
        0, std::min(wide.first[axis] + wide.size[axis], cubes.first[axis] + cubes.size[axis]) -
               box.first[axis]);
  }
  // Each cube's place and bits, as surveyed, as chosen and as kept.
  const std::uint64_t cube_bytes = 3 * (sizeof(Int3) + words() * sizeof(std::uint64_t));
  const std::uint64_t most = params.memory_limit / cube_bytes;
  CubeSurvey survey = piles::survey_cubes(rule, box, most);
  if (!survey.cubes) {
    const TileParams& t = tiles->params();
    const double stones =
        survey.filled_estimate * std::pow(t.n - 1, 3) * 0.5 * (t.seeds_min + t.seeds_max);
    throw job_error(fmt::format(
        "stone_size = {:.3g} m asks for about {:.2g} stones; to choose them takes more than the "
        "{:.3g} GB that are allowed; give at least about {:.3g} m, or fill region by region",
        tiling.cell_size, stones, static_cast<double>(params.memory_limit) / 1e9,
        tiling.cell_size * std::cbrt(survey.filled_estimate / static_cast<double>(most))));
  }
  return std::move(*survey.cubes);
}

CubeBits PileFiller::Impl::choose(const std::vector<Int3>& surveyed, const CubeBox& part,
                                  PileStats& stats, Job* job) const {
  const std::size_t stride = words();
  std::vector<std::uint64_t> bits(surveyed.size() * stride);
  const auto words_of = [&](std::size_t i) { return std::span(bits).subspan(i * stride, stride); };
  // Cubes of a block one after another.
  std::vector<std::size_t> order(surveyed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return is_before(piles::window_of(surveyed[a]), piles::window_of(surveyed[b]));
  });
  tbb::enumerable_thread_specific<CubeChooser> choosers(std::cref(rule));
  std::atomic<std::size_t> done = 0;
  std::atomic<std::uint64_t> chosen_voxels = 0, seeded_voxels = 0;
  parallel_for(
      surveyed.size(),
      [&](std::size_t k) {
        const std::size_t i = order[k];
        if (++done % 256 == 0)
          report_progress(job, "pile",
                          0.8 * static_cast<double>(done) / static_cast<double>(surveyed.size()));
        CubeChooser& chooser = choosers.local();
        chooser.choose(surveyed[i], words_of(i));
        if (!part.contains(surveyed[i])) return;
        chosen_voxels += chooser.volume().chosen;
        seeded_voxels += chooser.volume().seeded;
      },
      kGrain);
  stats.chosen_voxels = chosen_voxels;
  stats.seeded_voxels = seeded_voxels;
  CubeBits chosen(stride);
  for (std::size_t i = 0; i < surveyed.size(); ++i) chosen.append(surveyed[i], words_of(i));
  return chosen;
}

// Takes over the part's stones that can be seen, touch another one and are dense enough.
void PileFiller::Impl::leave_out(const CubeBits& chosen, const CubeBox& part, Pile& pile,
                                 Job* job) const {
  const std::size_t stride = chosen.words_per_cube();
  const bool is_alone = chosen.bit_count() == 1 && part == cubes;
  std::vector<std::uint64_t> bits(chosen.size() * stride);
  std::atomic<std::uint64_t> hidden = 0, isolated = 0, thinned = 0;
  std::vector<std::atomic<bool>> used(tiles->stones().size());
  tbb::enumerable_thread_specific<CubeChooser> choosers(std::cref(rule));
  tbb::enumerable_thread_specific<Neighborhood> neighborhoods(std::cref(*tiles), std::cref(chosen));
  tbb::enumerable_thread_specific<CubeStones> numberings(std::cref(*tiles));
  const auto leave_out_of_cube = [&](std::size_t i) {
    const Int3& cube = chosen.cube(i);
    if (!part.contains(cube)) return;
    const std::span<std::uint64_t> words = std::span(bits).subspan(i * stride, stride);
    std::ranges::copy(chosen.words(i), words.begin());
    if (params.surface_only) hidden += choosers.local().hide(cube, words);

    Neighborhood& neighborhood = neighborhoods.local();
    neighborhood.go_to(i);
    CubeStones& stones = numberings.local();
    stones.go_to(cube);
    for_each_bit(words, [&](std::uint32_t number) {
      const std::uint32_t stone = stones.stone(number);
      const Int3 cell = rule.period * cube + stones.cell_at(stones.cell_of(number));
      const bool touches = is_alone || neighborhood.touches_any(number);
      const bool is_left = touches && (!is_thinned() || is_kept(cell, stone));
      if (is_left && !used[stone].load(std::memory_order_relaxed))
        used[stone].store(true, std::memory_order_relaxed);
      if (is_left) return;
      set_bit(words, number, false);
      ++(touches ? thinned : isolated);
    });
  };
  parallel_for(
      chosen.size(),
      [&](std::size_t i) {
        if (i % 256 == 0) check_cancelled(job);
        leave_out_of_cube(i);
      },
      kGrain);

  for (std::size_t i = 0; i < chosen.size(); ++i)
    pile.stones.append(chosen.cube(i), std::span(bits).subspan(i * stride, stride));
  pile.stones.shrink_to_fit();
  pile.stats.instances = pile.stones.bit_count();
  pile.stats.unique = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));
  pile.stats.hidden = hidden;
  pile.stats.isolated = isolated;
  pile.stats.thinned = thinned;
}

void PileFiller::Impl::edit(const CubeBox& part, Pile& pile) const {
  const auto in_part = [&](const StoneId& stone) {
    return part.contains(piles::cube_of(stone.cell, rule.period));
  };
  for (const StoneId& stone : control.locked)
    if (in_part(stone)) place_stone(pile, stone);
  for (const StoneId& stone : control.removed)
    if (in_part(stone)) remove_stone(pile, stone);
  for (const StoneMove& move : control.moved)
    if (in_part(move.stone)) move_stone(pile, move);
}

PileFiller::PileFiller(const Support& support, std::shared_ptr<const TileSet> tiles,
                       const PileParams& params, const PileControl& control) {
  validate(params, "pile");
  if (control.density) check(*control.density);
  impl_ = std::make_unique<const Impl>(support, std::move(tiles), params, control);
}

PileFiller::~PileFiller() = default;

const Tiling& PileFiller::tiling() const { return impl_->tiling; }
const CubeBox& PileFiller::cubes() const { return impl_->cubes; }

Pile PileFiller::fill(const CubeBox& part, Job* job) const {
  report_progress(job, "pile", 0);
  Pile pile{.tiles = impl_->tiles,
            .tiling = impl_->tiling,
            .floor = impl_->bounds.min.z,
            .stones = CubeBits(impl_->words())};
  const CubeBits chosen = impl_->choose(impl_->survey(part), part, pile.stats, job);
  impl_->leave_out(chosen, part, pile, job);
  impl_->edit(part, pile);
  report_progress(job, "pile", 1);
  return pile;
}

namespace {

// Whether the support has stones of the tiling, seen or not.
bool has_stones(const Pile& pile) {
  return pile.stats.instances + pile.stats.hidden + pile.stats.thinned > 0;
}

// Tries smaller and smaller stones, as long as that is quick, to say what would fit.
[[noreturn]] void refuse_stone_size(const Support& support,
                                    const std::shared_ptr<const TileSet>& tiles,
                                    const PileParams& params, Job* job) {
  constexpr double kShrink = 0.9, kQuickCubes = 2000;
  const double longest = support.bounds().longest_side();
  const double asked = params.stone_size.in_metres(longest);
  PileParams smaller = params;
  smaller.stone_size = {std::min(asked, longest), RelativeLength::Unit::metres};
  for (double& size = smaller.stone_size.value;; size *= kShrink) {
    const PileFiller filler(support, tiles, smaller);
    if (filler.cubes().volume() > kQuickCubes) break;
    if (!has_stones(filler.fill(filler.cubes(), job))) continue;
    throw usage_error(fmt::format(
        "stone_size = {:.4g} m is too large: no stone fits into a support whose longest side is "
        "{:.4g} m; the largest size that fits is about {:.3g} m ({:.2g}%)",
        asked, longest, size, 100 * size / longest));
  }
  throw usage_error(fmt::format(
      "stone_size = {:.4g} m is too large: the support is so thin that no stone fits, of "
      "any size down to {:.3g} m; give a thicker support or a smaller stone_size",
      asked, smaller.stone_size.value / kShrink));
}

}  // namespace

Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles, const PileParams& params,
          const PileControl& control, Job* job) {
  const PileFiller filler(support, tiles, params, control);
  Pile pile = filler.fill(filler.cubes(), job);
  const bool is_emptied = !control.removed.empty() || !control.moved.empty();
  if (has_stones(pile) || is_emptied) return pile;
  // Smaller stones would not touch either.
  if (pile.stats.isolated > 0 && tiles->stats().contacts_mean < 1)
    throw usage_error(
        fmt::format("none of the {} stones that fit keeps a contact with another; lower "
                    "contacts.discard_fraction or weathering.depth",
                    pile.stats.isolated));
  if (control.keep_out)
    throw usage_error(fmt::format("no stone of stone_size = {:.4g} m fits beside what is kept out",
                                  pile.tiling.cell_size));
  refuse_stone_size(support, tiles, params, job);
}

Pile fill(const Support& support, std::shared_ptr<const TileSet> tiles, const PileParams& params,
          Job* job) {
  return fill(support, std::move(tiles), params, {}, job);
}

}  // namespace talus
