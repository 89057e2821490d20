#include "talus/rocks/block_prints.h"

namespace talus::rocks {
namespace {

// A hash of 32 bits for each lane.
Words mix(Words x, std::uint32_t a, std::uint32_t b) {
  x = (x ^ x >> 16) * a;
  x = (x ^ x >> 15) * b;
  return x ^ x >> 16;
}

}  // namespace

BlockPrints::BlockPrints(const Block& block, std::span<const Party> parties)
    : block_(block), sums_(block.candidates.size()) {
  for (const Party& party : parties) {
    const Int3& cell = party.cell;
    names_.push_back(extend(extend(extend(extend(0, party.seed), cell.x), cell.y), cell.z));
  }
  add_voxels();
}

void BlockPrints::add_voxels() {
  constexpr Words kLane = {0, 1, 2, 3, 4, 5, 6, 7};
  const float* clearance = block_.clearance.data();
  std::uint32_t place = 0;
  block_.for_each_run([&](const Int3&, int count, std::uint32_t owner) {
    Sums& sums = sums_[owner];
    const auto length = static_cast<std::uint32_t>(count);
    for (std::uint32_t k = 0; k < length; k += kLanes) {
      const Words voxel = kLane + (place + k);
      const Words key = load<Words>(clearance + k) + voxel * 0x9e3779b9u;
      const Words in_run = kLane < length - k;
      sums.first += mix(key, 0x7feb352du, 0x846ca68bu) & in_run;
      sums.second += mix(key ^ voxel, 0xd168aaadu, 0xaf723597u) & in_run;
    }
    clearance += length;
    place += length;
  });
}

std::vector<StonePrint> BlockPrints::prints() const {
  std::vector<StonePrint> result;
  for (const Sums& sums : sums_) {
    StonePrint print = {sums.faces, sums.squares};
    for (std::size_t k = 0; k < kLanes; ++k) {
      print[0] = extend(print[0], sums.first[k]);
      print[1] = extend(print[1], sums.second[k]);
    }
    result.push_back(print);
  }
  return result;
}

}  // namespace talus::rocks
