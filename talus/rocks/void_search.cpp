#include "talus/rocks/void_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/parallel.h"
#include "talus/rocks/stone_maker.h"

namespace talus::rocks {
namespace {

constexpr std::size_t kSample = 400;
constexpr int kHalvings = 9;
constexpr double kTolerance = 0.01;
constexpr double kMaxDepth = 0.5;

// Share of space that weathering to a depth leaves empty, measured on a sample of stones.
double voids_at(double depth, TileParams params, const BlockTable& blocks,
                std::span<const StoneKey> sample) {
  params.weathering.depth = depth;
  struct Share {
    double solid, whole;
  };
  std::vector<Share> shares(sample.size());
  constexpr std::size_t kGrain = 16;
  const auto parts = (sample.size() + kGrain - 1) / kGrain;
  const CellLayout& layout = blocks.layout();
  const double voxel = std::pow(layout.voxels_per_cell, -3);
  parallel_for(parts, [&](std::size_t part) {
    StoneMaker maker(params, blocks);
    for (std::size_t i = part * kGrain; i < std::min((part + 1) * kGrain, sample.size()); ++i) {
      const Stone stone = maker.make(sample[i]).stone;
      const double weight = layout.frequency(sample[i].cell);
      shares[i] = {weight * stone.volume, weight * voxel * static_cast<double>(stone.voxel_count)};
    }
  });
  Share sum{0, 0};
  for (const Share& s : shares) sum = {sum.solid + s.solid, sum.whole + s.whole};
  return 1 - sum.solid / sum.whole;
}

}  // namespace

TileParams with_depth_for_voids(const TileParams& params, const BlockTable& blocks,
                                std::span<const StoneKey> stones, Job* job) {
  if (!params.weathering.void_fraction) return params;
  const double target = *params.weathering.void_fraction;
  std::vector<StoneKey> sample;
  const std::size_t count = std::min(kSample, stones.size());
  for (std::size_t k = 0; k < count; ++k) sample.push_back(stones[k * stones.size() / count]);

  double shallow = 0, deep = kMaxDepth;
  for (int k = 0; k < kHalvings; ++k) {
    check_cancelled(job);
    const double middle = (shallow + deep) / 2;
    (voids_at(middle, params, blocks, sample) < target ? shallow : deep) = middle;
  }
  TileParams found = params;
  // An end that was never left is meant itself.
  found.weathering.depth = shallow == 0 ? 0 : deep == kMaxDepth ? kMaxDepth : (shallow + deep) / 2;
  const double reached = voids_at(found.weathering.depth, params, blocks, sample);
  if (std::abs(reached - target) > kTolerance)
    warn(job, fmt::format("tiles.weathering.void_fraction = {} cannot be reached with these stones "
                          "and contacts; the {} possible is {:.2f}",
                          target, reached < target ? "largest" : "smallest", reached));
  return found;
}

}  // namespace talus::rocks
