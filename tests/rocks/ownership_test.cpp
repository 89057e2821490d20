// Every tiling that can be put together is exact: one owner for every voxel, by one rule.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "rocks/tiling.h"
#include "talus/rocks/contacts.h"

namespace talus {
namespace {

using namespace rocks;
using test::for_each_cell;
using test::Tiling;
using test::varied_params;

constexpr int kTilings = 20;

struct Owner {
  Int3 cell{0};
  int seed = -1;
  int count = 0;
  bool operator==(const Owner&) const = default;
};

// Box of voxels, in coordinates of the lattice.
struct VoxelMap {
  Int3 min, size;
  std::vector<Owner> owners;

  VoxelMap(const Int3& first, const Int3& extent) : min(first), size(extent) {
    owners.resize(static_cast<std::size_t>(extent.x * extent.y * extent.z));
  }
  Owner* at(const Int3& voxel) {
    const Int3 p = voxel - min;
    if (p.x < 0 || p.y < 0 || p.z < 0 || p.x >= size.x || p.y >= size.y || p.z >= size.z)
      return nullptr;
    return &owners[static_cast<std::size_t>(p.x + size.x * (p.y + size.y * p.z))];
  }
};

// The cube at the origin and half a period around it, filled by placing stones.
VoxelMap assemble(const BlockTable& blocks, const Tiling& tiling) {
  const CellLayout& layout = blocks.layout();
  const int half = layout.period_voxels() / 2;
  VoxelMap map(Int3(-half), Int3(4 * half));
  StoneGrid grid;
  for_each_cell(Int3(-2 * layout.period()), Int3(3 * layout.period()), [&](const Int3& cell) {
    const std::size_t seeds = tiling.seeds(blocks.seeds(), cell).size();
    for (std::uint16_t k = 0; k < seeds; ++k) {
      if (!grid.gather(blocks, tiling.key(cell, k))) continue;
      for (std::size_t i = 0; i < grid.count(); ++i) {
        if (!grid.own()[i]) continue;
        if (Owner* owner = map.at(grid.voxel_at(i) + layout.voxels_per_cell * cell))
          *owner = {cell, k, owner->count + 1};
      }
    }
  });
  return map;
}

// The rule of docs/rocks.md written down once more, without blocks: along an axis a voxel lies in
// interval A of corner q or in B after it; cells q P - R ... q P + R or q P + 1 ... q P + P - 1
// compete, each within its reach.
class DirectRule {
 public:
  DirectRule(const SeedTable& seeds, const Tiling& tiling) : seeds_(seeds), tiling_(tiling) {}

  Owner owner(const Int3& voxel) const {
    const CellLayout& layout = seeds_.layout();
    Int3 first, last;
    for (int axis = 0; axis < 3; ++axis) window(voxel[axis], first[axis], last[axis]);
    Owner best;
    float least = std::numeric_limits<float>::infinity();
    for_each_cell(first, last + 1, [&](const Int3& cell) {
      const Int3 offset = voxel - layout.voxels_per_cell * cell;
      float penalty = 1;
      for (int axis = 0; axis < 3; ++axis)
        penalty = std::max(penalty, penalty_along(tiling_.local(cell)[axis], offset[axis]));
      const auto seeds = tiling_.seeds(seeds_, cell);
      for (std::size_t k = 0; k < seeds.size(); ++k) {
        const Vec3f p = Vec3f(offset) + 0.5f;
        const float d = seeds[k].distance(p.x, p.y, p.z) * penalty;
        if (d < least) {
          least = d;
          best = {cell, static_cast<int>(k), 1};
        }
      }
    });
    return best;
  }

 private:
  void window(int voxel, int& first, int& last) const {
    const CellLayout& layout = seeds_.layout();
    const int period = layout.period_voxels(), rho = layout.margin_voxels();
    const int q = static_cast<int>(std::floor(static_cast<double>(voxel + rho) / period));
    const bool in_a = voxel - q * period < layout.voxels_per_cell + rho;
    first = q * layout.period() + (in_a ? -layout.radius : 1);
    last = q * layout.period() + (in_a ? layout.radius : layout.period() - 1);
  }
  float penalty_along(int l, int offset) const {
    const CellLayout& layout = seeds_.layout();
    const int v = layout.voxels_per_cell, rho = layout.margin_voxels(), p = layout.period_voxels();
    const bool low = l <= layout.radius, high = l >= layout.period() - layout.radius;
    const int begin = (low ? -rho : v + rho) - l * v;
    const int end = (l == 0 ? v + rho : high ? p + v + rho : p - rho) - l * v;
    const float x = static_cast<float>(offset) + 0.5f;
    const float u = std::min(x - static_cast<float>(begin), static_cast<float>(end) - x);
    const float t = std::min(u / (0.5f * static_cast<float>(rho)), 1.0f);
    return t > 0 ? 1 / (t * t * (3 - 2 * t)) : std::numeric_limits<float>::infinity();
  }

  const SeedTable& seeds_;
  const Tiling& tiling_;
};

TEST(Ownership, EveryVoxelOfRandomTilingsHasExactlyOneOwner) {
  for (int variant = 0; variant < kTilings; ++variant) {
    const BlockTable blocks(varied_params(variant), static_cast<std::uint64_t>(variant), nullptr);
    const Tiling tiling(blocks.layout(), 100 + static_cast<std::uint64_t>(variant));
    VoxelMap map = assemble(blocks, tiling);
    for (const Owner& owner : map.owners) ASSERT_EQ(owner.count, 1) << "variant " << variant;
  }
}

// A stone is computed once and placed wherever its colors occur; the direct rule knows the tiling
// around each place. Their agreement means that every repetition is the same stone.
TEST(Ownership, PlacedStonesAgreeWithTheRuleEvaluatedInThatTiling) {
  for (int variant = 0; variant < kTilings; ++variant) {
    const BlockTable blocks(varied_params(variant), static_cast<std::uint64_t>(variant), nullptr);
    const Tiling tiling(blocks.layout(), 200 + static_cast<std::uint64_t>(variant));
    VoxelMap map = assemble(blocks, tiling);
    const DirectRule rule(blocks.seeds(), tiling);
    for (int i = 0; i < 3000; ++i) {
      const auto place = static_cast<std::uint64_t>(variant * 10000 + i);
      Int3 voxel;
      for (int axis = 0; axis < 3; ++axis)
        voxel[axis] =
            map.min[axis] +
            static_cast<int>(uniform(hash(5, Purpose::texture, place, axis)) * map.size[axis]);
      ASSERT_EQ(*map.at(voxel), rule.owner(voxel)) << "variant " << variant;
    }
  }
}

TEST(Ownership, FieldsOfTwoStonesNeverSumAboveZero) {
  const BlockTable blocks(varied_params(2), 1, nullptr);
  const CellLayout& layout = blocks.layout();
  const Tiling tiling(layout, 1);
  std::map<std::array<int, 3>, std::vector<float>> fields;  // all stones' values at a voxel
  StoneGrid grid;
  for_each_cell(Int3(0), Int3(layout.period() + 1), [&](const Int3& cell) {
    if (!grid.gather(blocks, tiling.key(cell, 0))) return;
    for (std::size_t i = 0; i < grid.count(); ++i) {
      const Int3 v = grid.voxel_at(i) + layout.voxels_per_cell * cell;
      fields[{v.x, v.y, v.z}].push_back(grid.distances()[i]);
    }
  });
  std::size_t shared = 0;
  for (auto& [voxel, values] : fields) {
    std::sort(values.rbegin(), values.rend());
    if (values.size() < 2) continue;
    ++shared;
    ASSERT_LE(values[0] + values[1], 0);
  }
  EXPECT_GT(shared, 10000u);
}

// The contacts of one stone, by neighbor.
std::map<std::array<int, 4>, Int3> contacts_of(const BlockTable& blocks, const Tiling& tiling,
                                               const Int3& cell, std::uint16_t seed) {
  StoneGrid grid;
  ContactFinder finder;
  std::map<std::array<int, 4>, Int3> result;
  if (!grid.gather(blocks, tiling.key(cell, seed))) return result;
  for (const Contact& c : finder.find(grid)) {
    const Int3 other = cell + c.cell;
    result[{other.x, other.y, other.z, c.seed}] =
        c.face + 2 * blocks.layout().voxels_per_cell * cell;
  }
  return result;
}

TEST(Contacts, BothStonesFindTheSameFace) {
  std::size_t pairs = 0;
  for (int variant = 0; variant < 6; ++variant) {
    const BlockTable blocks(varied_params(variant), static_cast<std::uint64_t>(variant), nullptr);
    const Tiling tiling(blocks.layout(), 300 + static_cast<std::uint64_t>(variant));
    for_each_cell(Int3(0), Int3(blocks.layout().period()), [&](const Int3& cell) {
      for (const auto& [other, face] : contacts_of(blocks, tiling, cell, 0)) {
        const Int3 neighbor(other[0], other[1], other[2]);
        const auto back =
            contacts_of(blocks, tiling, neighbor, static_cast<std::uint16_t>(other[3]));
        const auto found = back.find({cell.x, cell.y, cell.z, 0});
        ASSERT_NE(found, back.end());
        ASSERT_EQ(found->second, face);
        ++pairs;
      }
    });
  }
  EXPECT_GT(pairs, 1000u);
}

}  // namespace
}  // namespace talus
