#include "talus/piles/choice.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace talus::piles {
namespace {

constexpr int kGroup = 4;  // voxels along the edge of a group that is classified at once

std::uint64_t count_bits(const StoneSolid& solid) {
  std::uint64_t count = 0;
  for (const std::uint64_t word : solid.bits)
    count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

// Anchors of one stone among the voxels of its solid.
class AnchorCounter {
 public:
  AnchorCounter(const Support& support, const Stone& stone, double voxel_size,
                const Lattice& lattice, const Int3& cell)
      : support_(support),
        solid_(stone.solid),
        voxel_(voxel_size * lattice.cell_size),
        corner_(lattice.world(cell, voxel_size * Vec3(stone.solid.min))) {}

  // Box around the centers of voxels `begin` to `end`, the end excluded.
  Box3 centers(const Int3& begin, const Int3& end) const {
    return {center(begin), center(end - 1)};
  }

  struct Count {
    std::uint64_t inside = 0;
    std::uint64_t outside = 0;
  };
  void add(const Int3& begin, const Int3& end, Count& count) const {
    const BoxState state = support_.classify(centers(begin, end));
    for (int z = begin.z; z < end.z; ++z)
      for (int y = begin.y; y < end.y; ++y)
        for (int x = begin.x; x < end.x; ++x) {
          if (!solid_.test(x, y, z)) continue;
          const bool is_inside = state == BoxState::mixed ? support_.contains(center({x, y, z}))
                                                          : state == BoxState::inside;
          ++(is_inside ? count.inside : count.outside);
        }
  }

 private:
  Vec3 center(const Int3& voxel) const { return corner_ + voxel_ * (Vec3(voxel) + 0.5); }

  const Support& support_;
  const StoneSolid& solid_;
  double voxel_;
  Vec3 corner_;
};

}  // namespace

bool lies_inside(const Support& support, const Stone& stone, double voxel_size,
                 const Lattice& lattice, const Int3& cell, double fraction) {
  const AnchorCounter counter(support, stone, voxel_size, lattice, cell);
  const Int3 size = stone.solid.size;
  const Vec3 seed = lattice.world(cell, stone.seed_position);
  const std::uint64_t anchors = count_bits(stone.solid) + 1;
  const auto wanted =
      static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(anchors)));

  Box3 all = counter.centers(Int3(0), size);
  all.include(seed);
  const BoxState state = support.classify(all);
  if (state != BoxState::mixed) return state == BoxState::inside;

  AnchorCounter::Count count;
  ++(support.contains(seed) ? count.inside : count.outside);
  for (int z = 0; z < size.z; z += kGroup)
    for (int y = 0; y < size.y; y += kGroup)
      for (int x = 0; x < size.x; x += kGroup) {
        const Int3 begin(x, y, z);
        counter.add(begin, glm::min(begin + kGroup, size), count);
        if (count.inside >= wanted) return true;
        if (count.outside > anchors - wanted) return false;
      }
  return count.inside >= wanted;
}

}  // namespace talus::piles
