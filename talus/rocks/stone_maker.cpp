#include "talus/rocks/stone_maker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "talus/base/union_find.h"

namespace talus::rocks {
namespace {

// Middle of the box around a solid's voxels, in voxels relative to the stone's cell.
Vec3 middle(const StoneSolid& solid) { return Vec3(solid.min) + 0.5 * Vec3(solid.size); }

// Sets bits `begin` to `end` - 1; begin < end.
void set_bits(std::span<std::uint64_t> words, std::size_t begin, std::size_t end) {
  const std::size_t first = begin / 64, last = (end - 1) / 64;
  const std::uint64_t from = ~std::uint64_t{0} << (begin % 64);
  const std::uint64_t to = ~std::uint64_t{0} >> (63 - (end - 1) % 64);
  if (first == last) {
    words[first] |= from & to;
    return;
  }
  words[first] |= from;
  for (std::size_t w = first + 1; w < last; ++w) words[w] = ~std::uint64_t{0};
  words[last] |= to;
}

}  // namespace

StoneMaker::StoneMaker(const TileParams& params, const BlockTable& blocks)
    : blocks_(blocks),
      voxel_size_(1.0 / blocks.layout().voxels_per_cell),
      contact_finder_(params.contacts.discard_fraction),
      weathering_(params, blocks.layout().voxels_per_cell) {}

MadeStone StoneMaker::make(const StoneKey& key) {
  MadeStone made;
  Stone& stone = made.stone;
  stone.cell = key.cell;
  stone.seed = key.seed;
  stone.colors = key.code;
  if (!grid_.gather(blocks_, key)) return made;

  stone.seed_position = Vec3(grid_.seed_position()) * voxel_size_;
  stone.voxel_count = grid_.own_count();
  const std::vector<Contact>& contacts = contact_finder_.find(grid_);
  compute_field(weathering_.wear(grid_, contacts));
  made.fragment_voxels = keep_largest_piece();
  stone.contacts.reserve(contacts.size());
  for (const Contact& contact : contacts)
    stone.contacts.push_back({.cell = contact.cell,
                              .seed = contact.seed,
                              .kept = field_[grid_.index(contact.own_voxel)] > 0,
                              .face = contact.face});
  stone.solid = solid();
  if (stone.solid.bits.empty()) return made;

  add_field_outside();
  const Vec3 center = middle(stone.solid);
  stone.pivot = center * voxel_size_;
  // Voxel centers are the samples.
  add_mesh(Vec3f(Vec3(grid_.min()) + 0.5 - center), made);
  return made;
}

// In own voxels the smaller of the distance to the other stones and what weathering leaves; -1 in
// others. Limits in place of branches, for speed.
void StoneMaker::compute_field(std::span<const float> wear) {
  const std::size_t count = grid_.count();
  field_.resize(count);
  inside_.resize(count);
  const float *const distance = grid_.distances().data(), *const left = wear.data();
  const std::uint8_t* const own = grid_.own().data();
  float* const field = field_.data();
  std::uint8_t* const inside = inside_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float limit = 2 * static_cast<float>(own[i]) - 1;
    field[i] = std::min(std::min(distance[i], 2 * left[i] - 1), limit);
  }
  for (std::size_t i = 0; i < count; ++i) inside[i] = field[i] > 0;
}

// In voxels of others the field is the distance alone, so that no two stones' fields sum above zero
// and their trilinear solids never meet. It matters, and is set, only across an edge that the
// surface crosses.
void StoneMaker::add_field_outside() {
  const std::size_t count = field_.size();
  beside_.assign(count, 0);
  const std::uint8_t *const own = grid_.own().data(), *const in = inside_.data();
  std::uint8_t* const beside = beside_.data();
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t stride = grid_.stride(axis), end = count - stride;
    for (std::size_t i = stride; i < end; ++i) beside[i] |= in[i - stride] | in[i + stride];
  }
  for (std::size_t i = 0; i < count; ++i) beside[i] = beside[i] & (own[i] ^ 1);
  const float* const distance = grid_.distances().data();
  float* const field = field_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float limit = 2 * static_cast<float>(beside[i]) - 1;
    field[i] = std::max(field[i], std::min(distance[i], limit));
  }
}

// Pieces are joined run by run: with those they touch in the row before and in the layer before.
std::uint64_t StoneMaker::keep_largest_piece() {
  runs_.clear();
  bits_.assign(inside_);
  bits_.for_each_run([&](std::size_t begin, std::size_t end) { runs_.push_back({begin, end}); });
  UnionFind pieces(runs_.size());
  for (const int axis : {1, 2}) {
    const std::size_t stride = grid_.stride(axis);
    std::size_t before = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      while (runs_[before].end + stride <= runs_[r].begin) ++before;
      for (std::size_t k = before; k < r && runs_[k].begin + stride < runs_[r].end; ++k)
        pieces.join(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(k));
    }
  }

  sizes_.assign(runs_.size(), 0);
  for (std::size_t r = 0; r < runs_.size(); ++r)
    sizes_[pieces.root(static_cast<std::uint32_t>(r))] += runs_[r].end - runs_[r].begin;
  std::uint32_t largest = 0;
  std::uint64_t largest_size = 0, total = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::uint32_t root = pieces.root(static_cast<std::uint32_t>(r));
    total += runs_[r].end - runs_[r].begin;
    if (sizes_[root] <= largest_size) continue;
    largest_size = sizes_[root];
    largest = root;
  }
  if (total == largest_size) return 0;

  std::size_t kept = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (pieces.root(static_cast<std::uint32_t>(r)) == largest) {
      runs_[kept++] = runs_[r];
    } else {
      for (std::size_t i = runs_[r].begin; i < runs_[r].end; ++i) field_[i] = -1, inside_[i] = 0;
    }
  }
  runs_.resize(kept);
  return total - largest_size;
}

StoneSolid StoneMaker::solid() const {
  VoxelBox box;
  for (const Run& run : runs_)
    box.include({grid_.voxel_at(run.begin), grid_.voxel_at(run.end - 1)});
  StoneSolid solid;
  if (box.empty()) return solid;
  solid.min = box.min;
  solid.size = box.max - box.min + 1;
  const auto bits = static_cast<std::size_t>(solid.size.x) *
                    static_cast<std::size_t>(solid.size.y) * static_cast<std::size_t>(solid.size.z);
  solid.bits.resize((bits + 63) / 64);
  for (const Run& run : runs_) {
    const Int3 at = grid_.voxel_at(run.begin) - solid.min;
    const auto first = static_cast<std::size_t>(at.x + solid.size.x * (at.y + solid.size.y * at.z));
    set_bits(solid.bits, first, first + (run.end - run.begin));
  }
  return solid;
}

void StoneMaker::add_mesh(const Vec3f& first_sample, MadeStone& made) {
  TriangleMesh mesh = polygonize({grid_.size(), field_}, polygonize_scratch_);
  const auto voxel_size = static_cast<float>(voxel_size_);
  Vec3f low(std::numeric_limits<float>::max()), high(-low);
  float longest2 = 0;
  for (Vec3f& p : mesh.positions) {
    p = (p + first_sample) * voxel_size;
    low = glm::min(low, p);
    high = glm::max(high, p);
    longest2 = std::max(longest2, glm::dot(p, p));
  }
  Stone& stone = made.stone;
  stone.volume = signed_volume(mesh);
  stone.radius = std::sqrt(static_cast<double>(longest2));
  for (int axis = 0; axis < 3; ++axis)
    made.reach = std::max(
        {made.reach, -(stone.pivot[axis] + low[axis]), stone.pivot[axis] + high[axis] - 1});
  stone.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace talus::rocks
