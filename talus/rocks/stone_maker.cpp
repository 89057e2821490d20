#include "talus/rocks/stone_maker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace talus::rocks {
namespace {

// Middle of the box around a solid's voxels, in voxels relative to the stone's cell.
Vec3 middle(const StoneSolid& solid) { return Vec3(solid.min) + 0.5 * Vec3(solid.size); }

double farthest_vertex(const TriangleMesh& mesh) {
  float longest = 0;
  for (const Vec3f& p : mesh.positions) longest = std::max(longest, glm::dot(p, p));
  return std::sqrt(static_cast<double>(longest));
}

}  // namespace

StoneMaker::StoneMaker(const TileParams& params, const BlockTable& blocks)
    : blocks_(blocks),
      voxel_size_(1.0 / blocks.layout().voxels_per_cell),
      weathering_(params, blocks.layout().voxels_per_cell) {}

MadeStone StoneMaker::make(const StoneKey& key) {
  MadeStone made;
  Stone& stone = made.stone;
  stone.cell = key.cell;
  stone.seed = key.seed;
  stone.colors = key.code;
  if (!grid_.gather(blocks_, key)) return made;

  stone.seed_position = Vec3(grid_.seed_position()) * voxel_size_;
  stone.voxel_count = grid_.own_voxels().size();
  const std::vector<Contact>& contacts = contact_finder_.find(grid_);
  compute_field(weathering_.wear(grid_, contacts));
  made.fragment_voxels = keep_largest_piece();
  for (const Contact& contact : contacts)
    stone.contacts.push_back({.cell = contact.neighbor.cell,
                              .seed = contact.neighbor.seed,
                              .kept = field_[contact.own_voxel] > 0,
                              .face = contact.face});
  stone.solid = solid();
  if (stone.solid.bits.empty()) return made;

  stone.pivot = middle(stone.solid) * voxel_size_;
  stone.mesh = mesh(stone.pivot);
  stone.volume = signed_volume(*stone.mesh);
  stone.radius = farthest_vertex(*stone.mesh);
  return made;
}

// In own voxels the smaller of the distance to the other stones and what weathering leaves; in
// voxels of others the distance alone, needed only next to own ones. For every other stone the sum
// of the two fields is at most zero, so their trilinear solids never meet.
void StoneMaker::compute_field(std::span<const float> wear) {
  field_.assign(grid_.count(), -1.0f);
  for (const auto& [voxel, i] : grid_.own_voxels())
    field_[i] = std::min(grid_.distance(i), 2 * wear[i] - 1);
}

std::uint64_t StoneMaker::keep_largest_piece() {
  piece_.assign(grid_.count(), 0);
  std::uint32_t pieces = 0, largest = 0;
  std::uint64_t largest_size = 0, total = 0;
  for (const auto& [voxel, start] : grid_.own_voxels()) {
    if (field_[start] <= 0 || piece_[start] != 0) continue;
    piece_[start] = ++pieces;
    stack_.assign(1, start);
    std::uint64_t size = 0;
    while (!stack_.empty()) {
      const std::size_t i = stack_.back();
      stack_.pop_back();
      ++size;
      for (int axis = 0; axis < 3; ++axis)
        for (const std::ptrdiff_t step : {-grid_.stride(axis), grid_.stride(axis)}) {
          const std::size_t j = moved(i, step);
          if (field_[j] <= 0 || piece_[j] != 0) continue;
          piece_[j] = pieces;
          stack_.push_back(j);
        }
    }
    total += size;
    if (size > largest_size) {
      largest_size = size;
      largest = pieces;
    }
  }
  for (const auto& [voxel, i] : grid_.own_voxels())
    if (field_[i] > 0 && piece_[i] != largest) field_[i] = -1;
  return total - largest_size;
}

StoneSolid StoneMaker::solid() const {
  VoxelBox box;
  for (const auto& [voxel, i] : grid_.own_voxels())
    if (field_[i] > 0) box.include({voxel, voxel});
  StoneSolid solid;
  if (box.empty()) return solid;
  solid.min = box.min;
  solid.size = box.max - box.min + 1;
  const auto bits = static_cast<std::size_t>(solid.size.x) *
                    static_cast<std::size_t>(solid.size.y) * static_cast<std::size_t>(solid.size.z);
  solid.bits.resize((bits + 63) / 64);
  for (const auto& [voxel, i] : grid_.own_voxels()) {
    if (field_[i] <= 0) continue;
    const Int3 at = voxel - solid.min;
    const auto bit = static_cast<std::size_t>(at.x + solid.size.x * (at.y + solid.size.y * at.z));
    solid.bits[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  return solid;
}

std::shared_ptr<const TriangleMesh> StoneMaker::mesh(const Vec3& pivot) {
  // Samples of other stones matter only across an edge that the surface crosses.
  for (const auto& [voxel, i] : grid_.own_voxels()) {
    if (field_[i] <= 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const std::ptrdiff_t step : {-grid_.stride(axis), grid_.stride(axis)}) {
        const std::size_t j = moved(i, step);
        if (!grid_.own(j)) field_[j] = grid_.distance(j);
      }
  }
  TriangleMesh mesh = polygonize({grid_.size(), field_}, polygonize_scratch_);
  // Voxel centers are the samples.
  const Vec3f offset(Vec3(grid_.min()) + 0.5 - pivot / voxel_size_);
  for (Vec3f& p : mesh.positions) p = (p + offset) * static_cast<float>(voxel_size_);
  compute_normals(mesh);
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace talus::rocks
