#include "talus/piles/pile_support.h"

#include <algorithm>
#include <cmath>

#include "talus/piles/cube_stones.h"

namespace talus {
namespace {

constexpr double kFewVoxels = 64;  // that are looked at one by one

}  // namespace

PileSupport::PileSupport(const Pile& pile)
    : tiling_(pile.tiling),
      cube_voxels_(pile.tiles->params().voxels() / pile.tiles->params().n *
                   (pile.tiles->params().n - 1)),
      voxel_(pile.tiling.cell_size * pile.tiles->params().n / pile.tiles->params().voxels()) {
  const std::vector<PlacedStone> placed = placed_stones(pile);
  if (placed.empty()) return;
  const int period = pile.tiles->params().n - 1;
  Int3 last = piles::cube_of(placed.front().cell, period);
  first_ = last;
  for (const PlacedStone& stone : placed) {
    const Int3 cube = piles::cube_of(stone.cell, period);
    first_ = glm::min(first_, cube);
    last = glm::max(last, cube);
  }
  first_ -= 1;
  size_ = last + 2 - first_;
  slots_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                static_cast<std::size_t>(size_.z));
  for (const PlacedStone& stone : placed) add(pile.tiles->stones()[stone.stone], stone.cell);
}

// Every voxel of the solid sets the 27 around it.
void PileSupport::add(const Stone& stone, const Int3& cell) {
  const StoneSolid& solid = stone.solid;
  const int per_cell = static_cast<int>(std::lround(tiling_.cell_size / voxel_));
  for (int z = 0; z < solid.size.z; ++z)
    for (int y = 0; y < solid.size.y; ++y) {
      int begin = 0;
      while (begin < solid.size.x) {
        if (!solid.test(begin, y, z)) {
          ++begin;
          continue;
        }
        int end = begin + 1;
        while (end < solid.size.x && solid.test(end, y, z)) ++end;
        for (int around = 0; around < 9; ++around)
          set_row(
              per_cell * cell + solid.min + Int3(begin - 1, y + around % 3 - 1, z + around / 3 - 1),
              end - begin + 2);
        begin = end;
      }
    }
  const Vec3 first = Vec3(per_cell * cell + solid.min - 1), size(solid.size + 2);
  const double in_cells = voxel_ / tiling_.cell_size;
  bounds_.include(tiling_.world(Box3{in_cells * first, in_cells * (first + size)}));
}

void PileSupport::set_row(const Int3& first, int count) {
  for (int i = 0; i < count; ++i) {
    const Int3 voxel = first + Int3(i, 0, 0);
    const Int3 cube = piles::cube_of(voxel, cube_voxels_);
    const Int3 at = cube - first_;
    std::uint32_t& slot =
        slots_[static_cast<std::size_t>(at.x + size_.x * (at.y + size_.y * at.z))];
    if (slot == 0) {
      const auto edge = static_cast<std::size_t>(cube_voxels_);
      cubes_.push_back({.bits = std::vector<std::uint64_t>((edge * edge * edge + 63) / 64)});
      slot = static_cast<std::uint32_t>(cubes_.size());
    }
    CubeVoxels& voxels = cubes_[slot - 1];
    set_bit(voxels.bits, bit_of(voxel - cube_voxels_ * cube));
    voxels.box.include(Box3{Vec3(voxel), Vec3(voxel + 1)});
  }
}

const PileSupport::CubeVoxels* PileSupport::find(const Int3& cube) const {
  const Int3 at = cube - first_;
  if (!CubeBox{Int3(0), size_}.contains(at)) return nullptr;
  const std::uint32_t slot =
      slots_[static_cast<std::size_t>(at.x + size_.x * (at.y + size_.y * at.z))];
  return slot == 0 ? nullptr : &cubes_[slot - 1];
}

bool PileSupport::contains(const Vec3& p) const {
  if (!bounds_.contains(p)) return false;
  return is_set(Int3(glm::floor(glm::transpose(tiling_.turn) * (p - tiling_.origin) / voxel_)));
}

bool PileSupport::is_set(const Int3& voxel) const {
  const Int3 cube = piles::cube_of(voxel, cube_voxels_);
  const CubeVoxels* voxels = find(cube);
  return voxels && test_bit(voxels->bits, bit_of(voxel - cube_voxels_ * cube));
}

// The box around a box of the world, in voxels.
Box3 PileSupport::in_voxels(const Box3& world) const {
  const Tiling back{.turn = glm::transpose(tiling_.turn), .cell_size = 1 / voxel_};
  return back.world(Box3{world.min - tiling_.origin, world.max - tiling_.origin}).expanded(1e-6);
}

// Which kinds of voxels there are in a box of few.
BoxState PileSupport::look(const Int3& first, const Int3& last) const {
  bool any_set = false, any_clear = false;
  const auto for_each_voxel = [&](auto&& is_set) {
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
          (is_set(Int3(x, y, z)) ? any_set : any_clear) = true;
  };
  const Int3 cube = piles::cube_of(first, cube_voxels_), corner = cube_voxels_ * cube;
  const Int3 farthest = last - corner;
  if (std::max({farthest.x, farthest.y, farthest.z}) < cube_voxels_) {
    const CubeVoxels* voxels = find(cube);
    if (!voxels) return BoxState::outside;
    for_each_voxel([&](const Int3& v) { return test_bit(voxels->bits, bit_of(v - corner)); });
  } else {
    for_each_voxel([&](const Int3& v) { return is_set(v); });
  }
  if (any_set) return any_clear ? BoxState::mixed : BoxState::inside;
  return BoxState::outside;
}

BoxState PileSupport::classify(const Box3& box) const {
  const Box3 part{glm::max(box.min, bounds_.min), glm::min(box.max, bounds_.max)};
  if (part.empty()) return BoxState::outside;
  const Box3 voxels = in_voxels(part);
  const Int3 first_voxel(glm::floor(voxels.min)), last_voxel(glm::floor(voxels.max));
  const Vec3 size(last_voxel - first_voxel + 1);
  if (size.x * size.y * size.z <= kFewVoxels) {
    const BoxState state = look(first_voxel, last_voxel);
    const bool reaches_out = part.min != box.min || part.max != box.max;
    return state == BoxState::inside && reaches_out ? BoxState::mixed : state;
  }

  const Int3 first = piles::cube_of(first_voxel, cube_voxels_);
  const Int3 last = piles::cube_of(last_voxel, cube_voxels_);
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const CubeVoxels* cube = find({x, y, z});
        if (!cube) continue;
        const Box3 common{glm::max(voxels.min, cube->box.min), glm::min(voxels.max, cube->box.max)};
        if (!common.empty()) return BoxState::mixed;
      }
  return BoxState::outside;
}

BlockStates PileSupport::classify_block(const PointBlock& centers, const Vec3& half) const {
  // Boxes in reach of the bounds' border, or of many voxels, as any other.
  const Box3 around = centers.box_around(half);
  if (classify(around) == BoxState::outside) return {.outside = ~std::uint64_t{0}};
  const Box3 one = in_voxels({tiling_.origin - half, tiling_.origin + half});
  const Vec3 most = glm::ceil(one.size()) + 1.0;
  const bool is_within = bounds_.contains(around.min) && bounds_.contains(around.max);
  if (!is_within || most.x * most.y * most.z > kFewVoxels)
    return Support::classify_block(centers, half);

  const glm::dmat3 back = glm::transpose(tiling_.turn) / voxel_;
  const Vec3 half_voxels = 0.5 * one.size();
  PointBlock block{.first = back * (centers.first - tiling_.origin)};
  for (std::size_t axis = 0; axis < 3; ++axis) block.step[axis] = back * centers.step[axis];
  BlockStates states;
  for (int i = 0; i < kBlockPoints; ++i) {
    const Vec3 center = block.point(i);
    const BoxState state =
        look(Int3(glm::floor(center - half_voxels)), Int3(glm::floor(center + half_voxels)));
    states.inside |= std::uint64_t{state == BoxState::inside} << i;
    states.outside |= std::uint64_t{state == BoxState::outside} << i;
  }
  return states;
}

}  // namespace talus
