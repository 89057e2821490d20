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
  meet_at(contacts);
  made.fragment_voxels = keep_largest_piece();
  stone.contacts.reserve(contacts.size());
  for (const Contact& contact : contacts)
    stone.contacts.push_back({.cell = contact.cell,
                              .seed = contact.seed,
                              .kept = field_[grid_.index(contact.own_voxel)] > 0,
                              .face = contact.face});
  stone.solid = solid();
  if (stone.solid.bits.empty()) return made;

  const Vec3 center = middle(stone.solid);
  stone.pivot = center * voxel_size_;
  // Voxel centers are the samples.
  add_mesh(Vec3f(Vec3(grid_.min()) + 0.5 - center), made);
  return made;
}

// In own voxels the smaller of the distance and what weathering leaves; in others the distance
// alone, so that no two stones' fields sum above zero and their trilinear solids never meet.
void StoneMaker::compute_field(std::span<const float> wear) {
  const std::size_t count = grid_.count();
  field_.resize(count);
  inside_.resize(count);
  const float *const distance = grid_.distances().data(), *const left = wear.data();
  const std::uint8_t* const own = grid_.own().data();
  float* const field = field_.data();
  std::uint8_t* const inside = inside_.data();
  for (std::size_t i = 0; i < count; ++i) {
    // Above any distance in others' voxels.
    const float limit = 2 * (left[i] + static_cast<float>(own[i] ^ 1)) - 1;
    field[i] = std::min(distance[i], limit);
  }
  for (std::size_t i = 0; i < count; ++i) inside[i] = field[i] > 0;
}

// Across the faces of contacts the field is nearly the opposite of the neighbor's, even if a third
// stone is near, so that the surfaces cross the line between the two voxels' centers at most a
// ninth of a voxel from each other. (Exactly the opposite, more meshes would go into each other
// there.)
void StoneMaker::meet_at(std::span<const Contact> contacts) {
  constexpr float kApart = 1.25f;
  for (const Contact& contact : contacts) {
    float& field = field_[grid_.index(contact.voxel_beyond())];
    field = std::max(field, -kApart * grid_.clearance(contact.voxel_beyond()));
  }
}

// Pieces are joined run by run: with those they touch in the row before and in the layer before.
std::uint64_t StoneMaker::keep_largest_piece() {
  runs_.clear();
  bits_.assign(inside_);
  bits_.for_each_run([&](std::size_t begin, std::size_t end) { runs_.push_back({begin, end}); });
  UnionFind pieces(runs_.size());
  std::size_t piece_count = runs_.size();
  for (const int axis : {1, 2}) {
    const std::size_t stride = grid_.stride(axis);
    std::size_t before = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      while (runs_[before].end + stride <= runs_[r].begin) ++before;
      for (std::size_t k = before; k < r && runs_[k].begin + stride < runs_[r].end; ++k)
        piece_count -= pieces.join(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(k));
    }
  }
  if (piece_count == 1) return 0;

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

void StoneMaker::for_each_run(auto&& use) const {
  const auto row_length = static_cast<std::size_t>(grid_.size().x);
  std::size_t row = 0;
  int y = 0, z = 0;
  for (const Run& run : runs_) {
    for (; row + row_length <= run.begin; row += row_length)
      if (++y == grid_.size().y) y = 0, ++z;
    use(Int3(run.begin - row, y, z), static_cast<int>(run.end - run.begin));
  }
}

StoneSolid StoneMaker::solid() const {
  VoxelBox box;
  for_each_run([&](const Int3& first, int length) {
    box.include({first, first + Int3(length - 1, 0, 0)});
  });
  StoneSolid solid;
  if (box.empty()) return solid;
  solid.min = grid_.min() + box.min;
  solid.size = box.max - box.min + 1;
  const auto bits = static_cast<std::size_t>(solid.size.x) *
                    static_cast<std::size_t>(solid.size.y) * static_cast<std::size_t>(solid.size.z);
  solid.bits.resize((bits + 63) / 64);
  for_each_run([&](const Int3& first, int length) {
    const Int3 at = first - box.min;
    const auto bit = static_cast<std::size_t>(at.x + solid.size.x * (at.y + solid.size.y * at.z));
    set_bits(solid.bits, bit, bit + static_cast<std::size_t>(length));
  });
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
