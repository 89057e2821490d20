#include "talus/rocks/contacts.h"

#include <algorithm>
#include <array>

namespace talus::rocks {
namespace {

bool before(const Int3& a, const Int3& b) {
  return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
}

}  // namespace

// The surface to one neighbor may lie in several blocks.
void ContactFinder::collect(const StoneGrid& grid) {
  for (const StoneGrid::Piece& piece : grid.pieces()) {
    if (!piece.self) continue;
    for (const Patch& patch : piece.block->patches.of(*piece.self)) {
      if (!patch.known_to_both) continue;
      const Int3 cell = patch.cell + piece.cells;
      std::size_t i = 0;
      while (i < contacts_.size() && (contacts_[i].cell != cell || contacts_[i].seed != patch.seed))
        ++i;
      if (i == contacts_.size()) {
        contacts_.push_back({.cell = cell, .seed = patch.seed});
        surfaces_.push_back({});
      }
      surfaces_[i].faces += patch.faces;
      surfaces_[i].sum += patch.sum + 2 * patch.faces * glm::i64vec3(piece.offset);
      parts_.push_back({&piece, &patch, i});
    }
  }
}

// Of the faces of a run, which differ in x alone, only the two around the middle can be nearest.
void ContactFinder::choose(const FaceRun& run, const Int3& offset, std::size_t index) {
  const Surface& surface = surfaces_[index];
  const Int3 first = run.middle() + 2 * offset;
  const std::int64_t beyond = surface.sum.x - surface.faces * first.x;
  const int last = run.length - 1;
  const int below = static_cast<int>(
      std::clamp<std::int64_t>(last > 0 ? beyond / (2 * surface.faces) : 0, 0, last));
  for (int k = below; k <= std::min(below + 1, last); ++k)
    choose(first + Int3(2 * k, 0, 0), run.voxel + offset + Int3(k, 0, 0), index);
}

void ContactFinder::choose(const Int3& face, const Int3& own_voxel, std::size_t index) {
  Surface& surface = surfaces_[index];
  const glm::i64vec3 at(face);
  // Up to a constant, the squared distance to the middle times the number of faces.
  const auto dot = [](const glm::i64vec3& a, const glm::i64vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  };
  const std::int64_t distance = surface.faces * dot(at, at) - 2 * dot(at, surface.sum);
  Contact& contact = contacts_[index];
  if (distance > surface.best || (distance == surface.best && !before(face, contact.face))) return;
  surface.best = distance;
  contact.face = face;
  contact.own_voxel = own_voxel;
}

const std::vector<Contact>& ContactFinder::find(const StoneGrid& grid) {
  surfaces_.clear();
  parts_.clear();
  contacts_.clear();
  collect(grid);
  for (const Part& part : parts_)
    for (const FaceRun& run : part.piece->block->patches.runs_of(*part.patch))
      choose(run, part.piece->offset, part.contact);
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    return a.cell != b.cell ? before(a.cell, b.cell) : a.seed < b.seed;
  });
  return contacts_;
}

}  // namespace talus::rocks
