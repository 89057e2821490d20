#include "talus/rocks/contacts.h"

#include <algorithm>
#include <array>

namespace talus::rocks {
namespace {

bool contains(const VoxelBox& box, const Int3& voxel) {
  for (int axis = 0; axis < 3; ++axis)
    if (voxel[axis] < box.min[axis] || voxel[axis] > box.max[axis]) return false;
  return true;
}

bool before(const Int3& a, const Int3& b) {
  return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
}

}  // namespace

std::size_t ContactFinder::patch_of(const StoneGrid& grid, std::int32_t tag) {
  for (const auto& [known_tag, patch] : patch_by_tag_)
    if (known_tag == tag) return patch;
  const Neighbor neighbor = grid.neighbor(tag);
  std::size_t patch = 0;
  while (patch < patches_.size() && !(patches_[patch].neighbor == neighbor)) ++patch;
  if (patch == patches_.size()) patches_.push_back({.neighbor = neighbor});
  patch_by_tag_.emplace_back(tag, patch);
  return patch;
}

void ContactFinder::collect_faces(const StoneGrid& grid) {
  for (const auto& [voxel, i] : grid.own_voxels())
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        const std::size_t other = moved(i, side * grid.stride(axis));
        const std::int32_t tag = grid.owner(other);
        if (tag == StoneGrid::kOwn || tag == StoneGrid::kUnknown) continue;
        if (tag != last_tag_) {
          last_tag_ = tag;
          last_patch_ = patch_of(grid, tag);
        }
        Patch& patch = patches_[last_patch_];
        if (!contains(patch.neighbor.known, voxel)) continue;
        Int3 middle = 2 * voxel + 1;
        middle[axis] += side;
        faces_.push_back({last_patch_, i, middle});
        ++patch.faces;
        patch.sum += glm::i64vec3(middle);
      }
}

const std::vector<Contact>& ContactFinder::find(const StoneGrid& grid) {
  patches_.clear();
  patch_by_tag_.clear();
  faces_.clear();
  contacts_.clear();
  last_tag_ = StoneGrid::kUnknown;
  collect_faces(grid);

  for (const Face& face : faces_) {
    Patch& patch = patches_[face.patch];
    const glm::i64vec3 offset = patch.faces * glm::i64vec3(face.middle) - patch.sum;
    const std::int64_t distance = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
    if (patch.has_best &&
        (distance > patch.best || (distance == patch.best && before(patch.face, face.middle))))
      continue;
    patch.has_best = true;
    patch.best = distance;
    patch.face = face.middle;
    patch.own_voxel = face.own_voxel;
  }
  for (const Patch& patch : patches_)
    if (patch.has_best) contacts_.push_back({patch.neighbor, patch.face, patch.own_voxel});
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    if (a.neighbor.cell != b.neighbor.cell) return before(a.neighbor.cell, b.neighbor.cell);
    return a.neighbor.seed < b.neighbor.seed;
  });
  return contacts_;
}

}  // namespace talus::rocks
