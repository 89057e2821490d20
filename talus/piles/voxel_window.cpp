#include "talus/piles/voxel_window.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace talus::piles {
namespace {

// Voxels along what is asked for at once: a group of 4 x 4 x 4 bricks, a brick by pairs of voxels
// along each axis, a leaf by single voxels.
constexpr int kGroup = 32, kBrick = 8, kPair = 2, kLeaf = 4;

constexpr std::uint64_t kRowOfFour = 0xf, kRowOfBrick = 0xff;
// Four bits, each of them twice.
constexpr std::uint64_t in_pairs(std::uint64_t bits) {
  const std::uint64_t apart = (bits & 1) | (bits & 2) << 1 | (bits & 4) << 2 | (bits & 8) << 3;
  return 3 * apart;
}

// Half the axis-aligned box around centers of voxels, this many steps apart.
Vec3 half_box(const Vec3& steps, const std::array<Vec3, 3>& step) {
  return 0.5 *
         (steps.x * glm::abs(step[0]) + steps.y * glm::abs(step[1]) + steps.z * glm::abs(step[2]));
}

// Centers are rounded one by one.
Vec3 with_slack(const Vec3& half, const Vec3& middle) {
  return half + 1e-12 * (glm::abs(middle) + half);
}

// At most this many bits, from any place, are in the eight bytes that begin with the first's.
constexpr int kBitsAtOnce = 57;
std::uint64_t bits_at(const std::uint64_t* words, std::size_t first, int count) {
  std::uint64_t bits;
  std::memcpy(&bits, reinterpret_cast<const char*>(words) + first / 8, sizeof bits);
  return bits >> (first % 8) & (~std::uint64_t{0} >> (64 - count));
}

std::uint64_t count_bits(std::uint64_t bits) {
  return static_cast<std::uint64_t>(std::popcount(bits));
}

}  // namespace

VoxelWindow::VoxelWindow(const TileSet& tiles, const Support& support, const Tiling& tiling)
    : voxels_per_cell_(tiles.params().voxels() / tiles.params().n),
      period_(tiles.params().n - 1),
      margin_(static_cast<int>(std::ceil(tiles.reach() * voxels_per_cell_)) + 1),
      support_(support),
      tiling_(tiling) {
  const int across = kWindowCubes * period_ * voxels_per_cell_ + 2 * margin_;
  const int bricks = (across + kBrick - 1) / kBrick;
  voxels_ = kBrick * bricks;
  row_words_ = static_cast<std::size_t>(voxels_ + 63) / 64;
  const std::size_t words = row(0, voxels_) + 1;  // one more, as rows are read eight bytes at once
  inside_.resize(words);
  open_.resize(words);
  bricks_.resize(static_cast<std::size_t>(bricks * bricks * bricks));
  is_open_.resize(leaf(Int3(0, 0, voxels_)));
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along(0);
    along[axis] = tiling.cell_size / voxels_per_cell_;
    step_[static_cast<std::size_t>(axis)] = tiling.turn * along;
  }
  half_brick_ = half_box(Vec3(kBrick), step_);
  half_pair_ = half_box(Vec3(kPair - 1), step_);
}

void VoxelWindow::go_to(const Int3& cube) {
  const Int3 window = window_of(cube);
  first_cell_ = period_ * cube;
  cube_ = margin_ + voxels_per_cell_ * period_ * (cube - kWindowCubes * window);
  if (window_ == window) return;
  window_ = window;
  for (auto* bits : {&inside_, &open_}) std::fill(bits->begin(), bits->end(), 0);
  std::fill(bricks_.begin(), bricks_.end(), Brick::unknown);
  std::fill(is_open_.begin(), is_open_.end(), 0);
  first_ =
      tiling_.world(Vec3(kWindowCubes * period_ * window) + (0.5 - margin_) / voxels_per_cell_);
  farthest_ = glm::abs(first_) + 2.0 * half_box(Vec3(voxels_ + kGroup), step_);
}

std::size_t VoxelWindow::leaf(const Int3& voxel) const {
  const Int3 at = voxel / kLeaf;
  const int leaves = voxels_ / kLeaf;
  return static_cast<std::size_t>(at.x + leaves * (at.y + leaves * at.z));
}

VoxelWindow::Brick& VoxelWindow::brick(const Int3& at) {
  const int bricks = voxels_ / kBrick;
  return bricks_[static_cast<std::size_t>(at.x + bricks * (at.y + bricks * at.z))];
}

Vec3 VoxelWindow::center(const Vec3& voxel) const {
  return first_ + voxel.x * step_[0] + voxel.y * step_[1] + voxel.z * step_[2];
}

PointBlock VoxelWindow::block(const Vec3& first, int apart) const {
  const double steps = apart;
  return {center(first), {steps * step_[0], steps * step_[1], steps * step_[2]}};
}

bool VoxelWindow::holds(const StoneSolid& solid, const Int3& cell, std::uint64_t wanted,
                        std::uint64_t all) {
  const Int3 at = cube_ + voxels_per_cell_ * cell + solid.min;
  const Int3 end = at + solid.size;
  switch (classify_bricks(at, end)) {
    case BoxState::inside:
      return all >= wanted;
    case BoxState::outside:
      return wanted == 0;
    case BoxState::mixed:
      break;
  }
  // Slice by slice, until the rest cannot change the answer: first by what is known, then by single
  // voxels.
  Count known;
  std::uint64_t left = all;
  for (int z = 0; z < solid.size.z; ++z) {
    const Count slice = count_slices(solid, at, z, z + 1);
    known.inside += slice.inside;
    known.open += slice.open;
    left -= slice.all;
    if (known.inside >= wanted) return true;
    if (known.inside + known.open + left < wanted) return false;
  }
  for (int z = 0, next = 0; z < solid.size.z; z = next) {
    next = std::min(solid.size.z, (at.z + z) / kLeaf * kLeaf + kLeaf - at.z);  // of other leaves
    const Count before = count_slices(solid, at, z, next);
    if (before.open == 0) continue;
    resolve(at, end, at.z + z);
    known.inside += count_slices(solid, at, z, next).inside - before.inside;
    known.open -= before.open;
    if (known.inside >= wanted) return true;
    if (known.inside + known.open < wanted) return false;
  }
  return false;
}

bool VoxelWindow::contains(const Int3& cell, const Vec3& position) {
  const Int3 voxel =
      cube_ + voxels_per_cell_ * cell + Int3(glm::floor(double(voxels_per_cell_) * position));
  const Int3 at = voxel / kBrick;
  if (brick(at) == Brick::unknown) classify_group(at * kBrick / kGroup);
  if (brick(at) == Brick::inside) return true;
  if (brick(at) == Brick::outside) return false;
  return support_.contains(tiling_.world(Vec3(first_cell_ + cell) + position));
}

// Asks for the bricks that a box of voxels touches; unless they are all alike, for their pairs.
BoxState VoxelWindow::classify_bricks(const Int3& begin, const Int3& end) {
  const Int3 first = begin / kBrick, last = (end - 1) / kBrick;
  const auto for_each_brick = [&](auto&& visit) {
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) visit(Int3(x, y, z));
  };
  bool all_inside = true, all_outside = true;
  for_each_brick([&](const Int3& at) {
    if (brick(at) == Brick::unknown) classify_group(at * kBrick / kGroup);
    all_inside &= brick(at) == Brick::inside;
    all_outside &= brick(at) == Brick::outside;
  });
  if (all_inside) return BoxState::inside;
  if (all_outside) return BoxState::outside;
  for_each_brick([&](const Int3& at) {
    if (brick(at) != Brick::mixed) return;
    classify_pairs(kBrick * at);
    brick(at) = Brick::in_pairs;
  });
  return BoxState::mixed;
}

void VoxelWindow::classify_group(const Int3& group) {
  const Vec3 first = Vec3(kGroup * group) + 0.5 * (kBrick - 1);
  const BlockStates states =
      support_.classify_block(block(first, kBrick), with_slack(half_brick_, farthest_));
  const Int3 begin = kGroup / kBrick * group;
  for (int i = 0; i < kBlockPoints; ++i) {
    const Int3 at = begin + Int3(i & 3, i >> 2 & 3, i >> 4);
    if (std::max({at.x, at.y, at.z}) >= voxels_ / kBrick) continue;
    const bool inside = states.inside >> i & 1, outside = states.outside >> i & 1;
    brick(at) = inside ? Brick::inside : outside ? Brick::outside : Brick::mixed;
    if (!inside) continue;
    for (int k = 0; k < kBrick * kBrick; ++k) {
      const Int3 row = kBrick * at + Int3(0, k % kBrick, k / kBrick);
      inside_[word(row)] |= kRowOfBrick << (row.x % 64);
    }
  }
}

void VoxelWindow::classify_pairs(const Int3& begin) {
  const BlockStates pairs = support_.classify_block(block(Vec3(begin) + 0.5 * (kPair - 1), kPair),
                                                    with_slack(half_pair_, farthest_));
  for (int k = 0; k < 16; ++k) {
    const std::uint64_t inside = pairs.inside >> (4 * k) & kRowOfFour;
    const std::uint64_t open = ~(pairs.inside | pairs.outside) >> (4 * k) & kRowOfFour;
    if ((inside | open) == 0) continue;
    const Int3 start = begin + kPair * Int3(0, k % 4, k / 4);
    for (int row = 0; row < kPair * kPair; ++row) {
      const std::size_t at = word(start + Int3(0, row % kPair, row / kPair));
      inside_[at] |= in_pairs(inside) << (begin.x % 64);
      open_[at] |= in_pairs(open) << (begin.x % 64);
    }
    if (open & 3) is_open_[leaf(start)] = 1;
    if (open & 12) is_open_[leaf(start + Int3(kLeaf, 0, 0))] = 1;
  }
}

// Asks for every open voxel of the leaves that a rectangle of voxels touches.
void VoxelWindow::resolve(const Int3& begin, const Int3& end, int z) {
  const Int3 first = Int3(begin.x, begin.y, z) / kLeaf * kLeaf;
  for (int y = first.y; y < end.y; y += kLeaf)
    for (int x = first.x; x < end.x; x += kLeaf) {
      std::uint8_t& is_open = is_open_[leaf({x, y, first.z})];
      if (is_open) resolve_leaf({x, y, first.z});
      is_open = 0;
    }
}

void VoxelWindow::resolve_leaf(const Int3& begin) {
  const std::uint64_t bits = support_.contains_block(block(Vec3(begin), 1));
  const std::uint64_t row = kRowOfFour << (begin.x % 64);
  for (int k = 0; k < kLeaf * kLeaf; ++k) {
    const std::size_t at = word(begin + Int3(0, k % kLeaf, k / kLeaf));
    inside_[at] |= (bits >> (4 * k) & kRowOfFour) << (begin.x % 64) & open_[at];
    open_[at] &= ~row;
  }
}

// Of a stone's voxels of some heights.
VoxelWindow::Count VoxelWindow::count_slices(const StoneSolid& solid, const Int3& at, int z_begin,
                                             int z_end) const {
  // Eight bytes from within the last word would end beyond it.
  const auto last_word = 64 * (solid.bits.size() - 1);
  const auto own_bits = [&](std::size_t first, int width) {
    return first < last_word
               ? bits_at(solid.bits.data(), first, width)
               : solid.bits.back() >> (first - last_word) & (~std::uint64_t{0} >> (64 - width));
  };
  Count count;
  for (int z = z_begin; z < z_end; ++z)
    for (int x = 0; x < solid.size.x; x += kBitsAtOnce) {
      const int width = std::min(kBitsAtOnce, solid.size.x - x);
      // Places of a row in the solid's bits and in the window's.
      auto own = static_cast<std::size_t>(x + solid.size.x * solid.size.y * z);
      std::size_t place = 64 * row(at.y, at.z + z) + static_cast<std::size_t>(at.x + x);
      for (int y = 0; y < solid.size.y; ++y) {
        const std::uint64_t bits = own_bits(own, width);
        count.all += count_bits(bits);
        count.inside += count_bits(bits & bits_at(inside_.data(), place, width));
        count.open += count_bits(bits & bits_at(open_.data(), place, width));
        own += static_cast<std::size_t>(solid.size.x);
        place += 64 * row_words_;
      }
    }
  return count;
}

}  // namespace talus::piles
