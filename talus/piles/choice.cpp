#include "talus/piles/choice.h"

#include <bit>
#include <cmath>

#include "talus/piles/cube_bits.h"

namespace talus::piles {
namespace {

std::uint32_t count_anchors(const Stone& stone) {
  if (!stone.mesh) return 0;
  std::uint32_t count = 1;  // the seed
  for (const std::uint64_t word : stone.solid.bits)
    count += static_cast<std::uint32_t>(std::popcount(word));
  return count;
}

// Mean radius of the balls around the stones that are not empty, in cells.
double mean_radius(const TileSet& tiles) {
  double sum = 0;
  std::size_t count = 0;
  for (const Stone& stone : tiles.stones())
    if (stone.mesh) {
      sum += stone.radius;
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

ChoiceRule make_rule(const Support& support, const Support* keep_out, const TileSet& tiles,
                     const PileParams& params, const Tiling& tiling) {
  ChoiceRule rule{.support = support,
                  .keep_out = keep_out,
                  .tiles = tiles,
                  .tiling = tiling,
                  .membership = params.membership,
                  .period = tiles.params().n - 1,
                  .hidden_depth = params.surface_depth * mean_radius(tiles) * tiling.cell_size};
  for (const Stone& stone : tiles.stones()) {
    const std::uint32_t anchors = count_anchors(stone);
    rule.anchors.push_back(anchors);
    rule.wanted.push_back(static_cast<std::uint32_t>(std::ceil(params.inside_fraction * anchors)));
  }
  return rule;
}

Box3 ChoiceRule::reach_of(const Int3& cube) const {
  const Vec3 first(period * cube);
  return tiling.world(Box3{first - tiles.reach(), first + (period + tiles.reach())});
}

CubeChooser::CubeChooser(const ChoiceRule& rule)
    : rule_(rule), stones_(rule.tiles), window_(rule.tiles, rule.support, rule.tiling) {
  if (rule.keep_out) keep_out_window_.emplace(rule.tiles, *rule.keep_out, rule.tiling);
}

// Sets the bits of stones that are not empty and for which `test(cell, stone index, has seed)`
// holds.
template <class Test>
void CubeChooser::set_where(std::span<std::uint64_t> chosen, Test&& test) {
  for (std::size_t cell = 0; cell < stones_.cell_count(); ++cell) {
    const TileSet::Run run = stones_.run(cell);
    for (std::uint32_t index = run.first; index < run.first + run.count; ++index) {
      if (rule_.anchors[index] == 0) continue;
      const std::uint32_t voxels = rule_.anchors[index] - 1;
      const bool has_seed =
          window_.contains(stones_.cell_at(cell), rule_.tiles.stones()[index].seed_position);
      if (has_seed) volume_.seeded += voxels;
      if (!test(cell, index, has_seed)) continue;
      volume_.chosen += voxels;
      set_bit(chosen, stones_.first_number(cell) + (index - run.first));
    }
  }
}

void CubeChooser::choose(const Int3& cube, std::span<std::uint64_t> chosen) {
  volume_ = {};
  const Box3 reach = rule_.reach_of(cube);
  const BoxState state = rule_.support.classify(reach);
  if (state == BoxState::outside) return;
  stones_.go_to(cube);
  if (state == BoxState::mixed) window_.go_to(cube);
  if (state == BoxState::inside) {
    set_all(chosen);
  } else if (rule_.membership == Membership::center) {
    set_where(chosen, [](std::size_t, std::uint32_t, bool has_seed) { return has_seed; });
  } else {
    set_where(chosen, [&](std::size_t cell, std::uint32_t index, bool has_seed) {
      return window_.holds(rule_.tiles.stones()[index].solid, stones_.cell_at(cell),
                           rule_.wanted[index] - has_seed, rule_.anchors[index] - 1);
    });
  }
  if (rule_.keep_out && rule_.keep_out->classify(reach) != BoxState::outside)
    keep_out(cube, chosen);
}

void CubeChooser::set_all(std::span<std::uint64_t> chosen) {
  for (std::size_t cell = 0; cell < stones_.cell_count(); ++cell) {
    const TileSet::Run run = stones_.run(cell);
    for (std::uint32_t k = 0; k < run.count; ++k) {
      if (rule_.anchors[run.first + k] == 0) continue;
      volume_.chosen += rule_.anchors[run.first + k] - 1;
      set_bit(chosen, stones_.first_number(cell) + k);
    }
  }
  volume_.seeded = volume_.chosen;
}

// Clears the bits of stones that reach into what is kept out, which is no part of the region.
void CubeChooser::keep_out(const Int3& cube, std::span<std::uint64_t> chosen) {
  window_.go_to(cube);
  keep_out_window_->go_to(cube);
  volume_ = {};
  for (std::size_t cell = 0; cell < stones_.cell_count(); ++cell) {
    const TileSet::Run run = stones_.run(cell);
    for (std::uint32_t k = 0; k < run.count; ++k) {
      const std::uint32_t index = run.first + k, number = stones_.first_number(cell) + k;
      if (rule_.anchors[index] == 0) continue;
      const Stone& stone = rule_.tiles.stones()[index];
      const std::uint32_t voxels = rule_.anchors[index] - 1;
      const bool is_out = keep_out_window_->contains(stones_.cell_at(cell), stone.seed_position);
      if (!is_out && window_.contains(stones_.cell_at(cell), stone.seed_position))
        volume_.seeded += voxels;
      if (!test_bit(chosen, number)) continue;
      if (is_out || keep_out_window_->holds(stone.solid, stones_.cell_at(cell), 1, voxels))
        set_bit(chosen, number, false);
      else
        volume_.chosen += voxels;
    }
  }
}

std::uint64_t CubeChooser::hide(const Int3& cube, std::span<std::uint64_t> chosen) {
  const double depth = rule_.hidden_depth;
  std::uint64_t hidden = 0;
  if (rule_.support.classify(rule_.reach_of(cube).expanded(depth)) == BoxState::inside) {
    for (std::uint64_t& word : chosen) {
      hidden += static_cast<std::uint64_t>(std::popcount(word));
      word = 0;
    }
    return hidden;
  }
  stones_.go_to(cube);
  for_each_bit(chosen, [&](std::uint32_t number) {
    const Int3 at = rule_.period * cube + stones_.cell_at(stones_.cell_of(number));
    const Vec3 pivot =
        rule_.tiling.world(Vec3(at) + rule_.tiles.stones()[stones_.stone(number)].pivot);
    if (rule_.support.classify({pivot - depth, pivot + depth}) != BoxState::inside) return;
    set_bit(chosen, number, false);
    ++hidden;
  });
  return hidden;
}

}  // namespace talus::piles
