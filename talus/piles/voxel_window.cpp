#include "talus/piles/voxel_window.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace talus::piles {
namespace {

// Voxels along a brick, which is asked for as a whole, and along its leaves, which are asked for
// voxel by voxel.
constexpr int kBrick = 8, kLeaf = 4;

// Half the axis-aligned box around centers of voxels, this many steps apart.
Vec3 half_box(const Vec3& steps, const std::array<Vec3, 3>& step) {
  return 0.5 *
         (steps.x * glm::abs(step[0]) + steps.y * glm::abs(step[1]) + steps.z * glm::abs(step[2]));
}

BoxState classify_around(const Support& support, const Vec3& middle, const Vec3& half) {
  // Centers are rounded one by one.
  const Vec3 reach = half + 1e-12 * (glm::abs(middle) + half);
  return support.classify({middle - reach, middle + reach});
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
  is_known_.resize(static_cast<std::size_t>(bricks * bricks * bricks));
  is_open_.resize(leaf(Int3(0, 0, voxels_)));
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along(0);
    along[axis] = tiling.cell_size / voxels_per_cell_;
    step_[static_cast<std::size_t>(axis)] = tiling.turn * along;
  }
  half_brick_ = half_box(Vec3(kBrick - 1), step_);
  half_leaf_ = half_box(Vec3(kLeaf - 1), step_);
}

void VoxelWindow::go_to(const Int3& cube) {
  const Int3 window = window_of(cube);
  cube_ = margin_ + voxels_per_cell_ * period_ * (cube - kWindowCubes * window);
  if (window_ == window) return;
  window_ = window;
  for (auto* bits : {&inside_, &open_}) std::fill(bits->begin(), bits->end(), 0);
  for (auto* flags : {&is_known_, &is_open_}) std::fill(flags->begin(), flags->end(), 0);
  first_ =
      tiling_.world(Vec3(kWindowCubes * period_ * window) + (0.5 - margin_) / voxels_per_cell_);
}

std::size_t VoxelWindow::leaf(const Int3& voxel) const {
  const Int3 at = voxel / kLeaf;
  const int leaves = voxels_ / kLeaf;
  return static_cast<std::size_t>(at.x + leaves * (at.y + leaves * at.z));
}

Vec3 VoxelWindow::center(const Vec3& voxel) const {
  return first_ + voxel.x * step_[0] + voxel.y * step_[1] + voxel.z * step_[2];
}

BoxState VoxelWindow::classify(const Int3& begin, int edge, const Vec3& half) const {
  return classify_around(support_, center(Vec3(begin) + 0.5 * (edge - 1)), half);
}

bool VoxelWindow::holds(const StoneSolid& solid, const Int3& cell, std::uint64_t wanted,
                        std::uint64_t all) {
  const Int3 at = cube_ + voxels_per_cell_ * cell + solid.min;
  const Vec3 steps(solid.size - 1);
  const BoxState state =
      classify_around(support_, center(Vec3(at) + 0.5 * steps), half_box(steps, step_));
  if (state == BoxState::inside) return all >= wanted;
  if (state == BoxState::outside) return wanted == 0;

  classify_bricks(at, at + solid.size);
  const Count known = count(solid, at);
  if (known.inside >= wanted) return true;
  if (known.inside + known.open < wanted) return false;
  resolve(at, at + solid.size);
  return count(solid, at).inside >= wanted;
}

// Asks for the bricks that a box of voxels touches.
void VoxelWindow::classify_bricks(const Int3& begin, const Int3& end) {
  const Int3 first = begin / kBrick, last = (end - 1) / kBrick;
  const int bricks = voxels_ / kBrick;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        std::uint8_t& is_known = is_known_[static_cast<std::size_t>(x + bricks * (y + bricks * z))];
        if (!is_known) classify_brick(kBrick * Int3(x, y, z));
        is_known = 1;
      }
}

void VoxelWindow::classify_brick(const Int3& begin) {
  const BoxState whole = classify(begin, kBrick, half_brick_);
  if (whole == BoxState::inside) set(inside_, begin, kBrick);
  if (whole != BoxState::mixed) return;
  for (int part = 0; part < 8; ++part) {
    const Int3 from = begin + kLeaf * Int3(part & 1, part >> 1 & 1, part >> 2 & 1);
    const BoxState state = classify(from, kLeaf, half_leaf_);
    if (state == BoxState::inside) set(inside_, from, kLeaf);
    if (state == BoxState::mixed) set(open_, from, kLeaf);
    is_open_[leaf(from)] = state == BoxState::mixed;
  }
}

// Asks for every open voxel of the leaves that a box of voxels touches.
void VoxelWindow::resolve(const Int3& begin, const Int3& end) {
  const Int3 first = begin / kLeaf * kLeaf;
  for (int z = first.z; z < end.z; z += kLeaf)
    for (int y = first.y; y < end.y; y += kLeaf)
      for (int x = first.x; x < end.x; x += kLeaf) {
        std::uint8_t& is_open = is_open_[leaf({x, y, z})];
        if (!is_open) continue;
        is_open = 0;
        for (int k = 0; k < kLeaf * kLeaf; ++k) {
          const Int3 start(x, y + k % kLeaf, z + k / kLeaf);
          const std::size_t word = row(start.y, start.z) + static_cast<std::size_t>(x) / 64;
          const std::uint64_t all = ((std::uint64_t{1} << kLeaf) - 1) << (x % 64);
          open_[word] &= ~all;
          inside_[word] |= support_.contains_row(center(Vec3(start)), step_[0], kLeaf) << (x % 64);
        }
      }
}

void VoxelWindow::set(std::vector<std::uint64_t>& bits, const Int3& begin, int edge) const {
  const std::uint64_t all = ((std::uint64_t{1} << edge) - 1) << (begin.x % 64);
  for (int z = begin.z; z < begin.z + edge; ++z)
    for (int y = begin.y; y < begin.y + edge; ++y)
      bits[row(y, z) + static_cast<std::size_t>(begin.x) / 64] |= all;
}

VoxelWindow::Count VoxelWindow::count(const StoneSolid& solid, const Int3& at) const {
  Count count;
  // Eight bytes from within the last word would end beyond it.
  const auto last_word = 64 * (solid.bits.size() - 1);
  const auto own_bits = [&](std::size_t first, int width) {
    return first < last_word
               ? bits_at(solid.bits.data(), first, width)
               : solid.bits.back() >> (first - last_word) & (~std::uint64_t{0} >> (64 - width));
  };
  for (int x = 0; x < solid.size.x; x += kBitsAtOnce) {
    const int width = std::min(kBitsAtOnce, solid.size.x - x);
    std::size_t own = static_cast<std::size_t>(x);  // place of a row in the solid's bits
    for (int z = 0; z < solid.size.z; ++z) {
      std::size_t place = 64 * row(at.y, at.z + z) + static_cast<std::size_t>(at.x + x);
      for (int y = 0; y < solid.size.y; ++y) {
        const std::uint64_t bits = own_bits(own, width);
        count.inside += count_bits(bits & bits_at(inside_.data(), place, width));
        count.open += count_bits(bits & bits_at(open_.data(), place, width));
        own += static_cast<std::size_t>(solid.size.x);
        place += 64 * row_words_;
      }
    }
  }
  return count;
}

}  // namespace talus::piles
