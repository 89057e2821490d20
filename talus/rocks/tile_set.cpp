#include "talus/rocks/tile_set.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/rocks/block_statistics.h"
#include "talus/rocks/deviation.h"
#include "talus/rocks/equal_stones.h"
#include "talus/rocks/stone_maker.h"
#include "talus/rocks/void_search.h"

namespace talus {
namespace {

using rocks::BlockTable;
using rocks::CellLayout;
using rocks::CornerBox;
using rocks::MadeStone;
using rocks::StoneKey;
using rocks::StoneMaker;

// Averages over all colorings.
void summarize(const CellLayout& layout, std::span<const Stone> stones, TileStats& stats) {
  double solid = 0, weights = 0, contacts = 0, lost = 0, found = 0, below_three = 0;
  stats.contacts_min = std::numeric_limits<std::uint64_t>::max();
  for (const Stone& stone : stones) {
    if (!stone.mesh) {
      ++stats.empty;
      continue;
    }
    const double weight = layout.frequency(stone.cell);
    const auto kept = static_cast<std::uint64_t>(std::count_if(
        stone.contacts.begin(), stone.contacts.end(), [](const auto& c) { return c.kept; }));
    solid += weight * stone.volume;
    weights += weight;
    contacts += weight * static_cast<double>(kept);
    found += weight * static_cast<double>(stone.contacts.size());
    lost += weight * static_cast<double>(stone.contacts.size() - kept);
    below_three += kept < 3 ? weight : 0;
    stats.contacts_min = std::min(stats.contacts_min, kept);
    stats.triangles += stone.mesh->triangles.size();
  }
  if (weights == 0) {
    stats.contacts_min = 0;
    return;
  }
  stats.void_fraction = 1 - solid / static_cast<double>(layout.cell_count());
  stats.contacts_mean = contacts / weights;
  stats.contacts_lost_fraction = found > 0 ? lost / found : 0;
  stats.below_three_fraction = below_three / weights;
}

// Only the first of equal stones.
std::vector<MadeStone> make_stones(const TileParams& params, const BlockTable& blocks,
                                   std::span<const StoneKey> keys,
                                   std::span<const std::uint32_t> first_equal, Job* job) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < keys.size(); ++i)
    if (first_equal[i] == i) order.push_back(i);
  // Stones of one coloring share blocks, which then stay in the processor's cache.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a].code < keys[b].code; });
  std::vector<MadeStone> made(keys.size());
  tbb::enumerable_thread_specific<StoneMaker> makers(std::cref(params), std::cref(blocks));
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kGrain = 64;
  parallel_for(
      order.size(),
      [&](std::size_t i) {
        made[order[i]] = makers.local().make(keys[order[i]]);
        if (++done % 256 == 0)
          report_progress(
              job, "tiles",
              0.2 + 0.8 * static_cast<double>(done) / static_cast<double>(order.size()));
      },
      kGrain);
  return made;
}

}  // namespace

std::vector<StoneKey> TileSet::list_stones(const rocks::SeedTable& seeds) {
  const CellLayout& layout = seeds.layout();
  std::vector<StoneKey> keys;
  for (std::size_t c = 0; c < layout.cell_count(); ++c) {
    const Int3 cell = layout.cell_at(c);
    const CornerBox stone_corners = layout.stone_corners(cell);
    const CornerBox seed_corners = layout.seed_corners(cell);
    cell_runs_.push_back(static_cast<std::uint32_t>(run_first_.size()));
    const std::uint32_t codes = rocks::code_count(stone_corners, layout.colors);
    for (std::uint32_t code = 0; code < codes; ++code) {
      run_first_.push_back(static_cast<std::uint32_t>(keys.size()));
      const std::uint32_t seed_code =
          rocks::color_code(seed_corners, layout.colors, [&](const Int3& corner) {
            return rocks::decode_color(stone_corners, layout.colors, code, corner);
          });
      const std::size_t count = seeds.seeds(cell, seed_code).size();
      for (std::size_t k = 0; k < count; ++k)
        keys.push_back({cell, code, static_cast<std::uint16_t>(k)});
    }
  }
  run_first_.push_back(static_cast<std::uint32_t>(keys.size()));
  return keys;
}

void TileSet::adopt(std::span<MadeStone> made, std::span<const StoneKey> keys,
                    std::span<const std::uint32_t> first_equal) {
  stones_.reserve(made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::uint32_t first = first_equal[i];
    stats_.fragments_removed += made[first].fragment_voxels;
    reach_ = std::max(reach_, made[first].reach);
    if (first == i) {
      stats_.distinct_meshes += made[i].stone.mesh != nullptr;
      stones_.push_back(std::move(made[i].stone));
    } else {
      stones_.push_back(stones_[first]);
      stones_.back().colors = keys[i].code;
      stones_.back().seed = keys[i].seed;
    }
  }
}

TileSet TileSet::make(const TileParams& params, std::uint64_t seed, Job* job,
                      std::vector<Stage>* phases) {
  validate_tiles(params);
  if (params.contacts.discard_fraction > 0)
    warn(job, fmt::format("tiles.contacts.discard_fraction = {}: stones may float",
                          params.contacts.discard_fraction));
  report_progress(job, "tiles", 0);
  StageTimer timer;
  const auto end_phase = [&](std::string_view name) {
    if (phases) phases->push_back(timer.stop(std::string(name)));
    timer = StageTimer();
  };
  const BlockTable blocks(params, seed, job);
  end_phase("labels and faces");
  report_progress(job, "tiles", 0.2);

  TileSet set;
  set.params_ = params;
  set.seed_ = seed;
  set.stats_.seed_spacing = rocks::least_seed_spacing(blocks);
  set.stats_.deviation_bound = rocks::deviation_bound(blocks, job);
  if (set.stats_.deviation_bound > rocks::kMuchDeviation)
    set.stats_.sufficient_n = rocks::find_sufficient_n(params, seed, job);
  end_phase("deviation bound");

  const std::vector<StoneKey> keys = set.list_stones(blocks.seeds());
  const std::vector<std::uint32_t> first_equal = rocks::find_equal_stones(blocks, keys);
  end_phase("equal stones");
  const TileParams resolved = rocks::with_depth_for_voids(params, blocks, keys, job);
  if (params.weathering.void_fraction) end_phase("depth for voids");
  std::vector<MadeStone> made = make_stones(resolved, blocks, keys, first_equal, job);
  end_phase("contacts, weathering and meshes");
  set.adopt(made, keys, first_equal);
  summarize(blocks.layout(), set.stones_, set.stats_);
  report_progress(job, "tiles", 1);
  return set;
}

TileSet::Run TileSet::run_at(const rocks::CellLayout& layout, const Int3& cell,
                             const CornerColors& corners) const {
  const std::uint32_t code = rocks::color_code(
      layout.stone_corners(cell), layout.colors,
      [&](const Int3& c) { return corners[static_cast<std::size_t>(c.x + 2 * c.y + 4 * c.z)]; });
  const std::size_t run = cell_runs_[layout.cell_index(cell)] + code;
  return {run_first_[run], run_first_[run + 1] - run_first_[run]};
}

TileSet::Run TileSet::stones_of(const Int3& cell, const CornerColors& corners) const {
  return run_at(CellLayout(params_), cell, corners);
}

void TileSet::stones_of_cube(const CornerColors& corners, std::vector<Run>& runs) const {
  const CellLayout layout(params_);
  runs.resize(layout.cell_count());
  for (std::size_t c = 0; c < runs.size(); ++c)
    runs[c] = run_at(layout, layout.cell_at(c), corners);
}

TileSet::Run TileSet::stones_at(const Int3& cell) const {
  const int period = params_.n - 1;
  Int3 cube;
  for (int axis = 0; axis < 3; ++axis) cube[axis] = floor_div(cell[axis], period);
  return stones_of(cell - period * cube, corner_colors(params_, seed_, cube));
}

std::uint8_t corner_color(const TileParams& params, std::uint64_t seed, const Int3& corner) {
  const CellLayout layout(params);
  const Int3 at = layout.colored_corner(corner);
  const std::uint64_t h = hash(seed, Purpose::corner_color, at.x, at.y, at.z);
  return static_cast<std::uint8_t>(uniform(h) * layout.colors);
}

CornerColors corner_colors(const TileParams& params, std::uint64_t seed, const Int3& cube) {
  CornerColors result;
  for (int i = 0; i < 8; ++i)
    result[static_cast<std::size_t>(i)] =
        corner_color(params, seed, cube + Int3(i & 1, i >> 1 & 1, i >> 2 & 1));
  return result;
}

}  // namespace talus
