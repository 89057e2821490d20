#include "talus/rocks/stone_maker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace talus::rocks {
namespace {

// Middle of the box around a solid's voxels, in voxels relative to the stone's cell.
Vec3 middle(const StoneSolid& solid) { return Vec3(solid.min) + 0.5 * Vec3(solid.size); }

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

std::uint64_t StoneMaker::keep_largest_piece() {
  bits_.assign(inside_);
  rows_.assign(grid_.size(), bits_);
  const std::size_t removed = rows_.keep_largest_piece();
  if (removed == 0) return 0;
  std::size_t i = 0;
  for (int z = 0; z < grid_.size().z; ++z)
    for (int y = 0; y < grid_.size().y; ++y)
      for (int x = 0; x < grid_.size().x; ++x, ++i)
        if (inside_[i] && !rows_.inside({x, y, z})) field_[i] = -1;
  return removed;
}

StoneSolid StoneMaker::solid() const {
  const GridRows::Box box = rows_.box();
  if (box.size.x == 0) return {};
  return {.min = grid_.min() + box.min, .size = box.size, .bits = rows_.packed(box)};
}

void StoneMaker::add_mesh(const Vec3f& first_sample, MadeStone& made) {
  TriangleMesh mesh = polygonize({.size = grid_.size(),
                                  .values = field_,
                                  .origin = first_sample,
                                  .spacing = static_cast<float>(voxel_size_)},
                                 polygonize_scratch_);
  Vec3f low(std::numeric_limits<float>::max()), high(-low);
  float longest2 = 0;
  for (const Vec3f& p : mesh.positions) {
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
