#include "talus/rocks/variation.h"

#include <cmath>

#include "talus/base/hash.h"

namespace talus::rocks {
namespace {

constexpr int kPerCell = 2;  // lattice points along the edge of a cell

float smoothstep(float t) { return t * t * (3 - 2 * t); }
float mix(float a, float b, float t) { return a + t * (b - a); }

}  // namespace

std::span<const std::uint16_t> Variation::factors(const StoneGrid& grid) {
  const float per_voxel =
      static_cast<float>(kPerCell) / static_cast<float>(grid.layout().voxels_per_cell);
  const auto seed_place = [&](int axis) {
    return static_cast<std::int64_t>(std::lround(4096 * per_voxel * grid.seed_position()[axis]));
  };
  const std::uint64_t stone =
      hash(0, Purpose::weathering, seed_place(0), seed_place(1), seed_place(2));

  // Random values in [-1, 1] at the lattice points around the grid, from `first` on.
  const auto lattice_at = [&](int voxel) { return per_voxel * (static_cast<float>(voxel) + 0.5f); };
  Int3 first, size;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = static_cast<int>(std::floor(lattice_at(grid.min()[axis])));
    size[axis] = static_cast<int>(std::floor(lattice_at(grid.min()[axis] + grid.size()[axis]))) -
                 first[axis] + 2;
  }
  lattice_.clear();
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const std::uint64_t h =
            extend(extend(extend(stone, first.x + x), first.y + y), first.z + z);
        lattice_.push_back(static_cast<float>(uniform(h, -1, 1)));
      }

  const auto own = static_cast<float>(0.5 * amount_ * uniform(stone, -1, 1));
  const auto around = static_cast<float>(0.5 * amount_);
  factors_.resize(grid.count());
  std::size_t out = 0;
  for (int z = 0; z < grid.size().z; ++z)
    for (int y = 0; y < grid.size().y; ++y)
      for (int x = 0; x < grid.size().x; ++x, ++out) {
        if (!grid.own()[out]) continue;
        const Vec3f at(lattice_at(grid.min().x + x), lattice_at(grid.min().y + y),
                       lattice_at(grid.min().z + z));
        const Int3 low(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                       static_cast<int>(std::floor(at.z)));
        const Vec3f t = at - Vec3f(low);
        const Int3 i = low - first;
        const auto corner = [&](int dx, int dy, int dz) {
          return lattice_[static_cast<std::size_t>(i.x + dx +
                                                   size.x * (i.y + dy + size.y * (i.z + dz)))];
        };
        const auto along_x = [&](int dy, int dz) {
          return mix(corner(0, dy, dz), corner(1, dy, dz), smoothstep(t.x));
        };
        const float noise =
            mix(mix(along_x(0, 0), along_x(1, 0), smoothstep(t.y)),
                mix(along_x(0, 1), along_x(1, 1), smoothstep(t.y)), smoothstep(t.z));
        factors_[out] = static_cast<std::uint16_t>(kOne * (1 + own + around * noise));
      }
  return factors_;
}

}  // namespace talus::rocks
