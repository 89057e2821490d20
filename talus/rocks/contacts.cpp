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

void ContactFinder::choose(const Part& part) {
  Surface& surface = surfaces_[part.contact];
  Contact& contact = contacts_[part.contact];
  const Int3& offset = part.piece->offset;
  const glm::i64vec3 twice_sum = std::int64_t{2} * surface.sum;
  // Up to a constant, the squared distance to the middle times the number of faces.
  const auto along = [&](int axis, std::int64_t at) {
    return at * (surface.faces * at - twice_sum[axis]);
  };
  const double middle_x = static_cast<double>(surface.sum.x) / static_cast<double>(surface.faces);
  for (const FaceRun& run : part.piece->block->patches.runs_of(*part.patch)) {
    Int3 face = run.middle() + 2 * offset;
    // Of a row of faces only the two around the middle can be nearest, the first of equals.
    const int last = run.length - 1;
    const int below = std::clamp(static_cast<int>((middle_x - face.x) / 2), 0, last);
    const int above = std::min(below + 1, last);
    const std::int64_t at_below = along(0, face.x + 2 * below);
    const std::int64_t at_above = along(0, face.x + 2 * above);
    const int step = at_above < at_below ? above : below;
    const std::int64_t distance =
        std::min(at_below, at_above) + along(1, face.y) + along(2, face.z);
    if (distance > surface.best) continue;
    face.x += 2 * step;
    if (distance == surface.best && !before(face, contact.face)) continue;
    surface.best = distance;
    contact.face = face;
    contact.own_voxel = run.voxel() + offset + Int3(step, 0, 0);
  }
}

const std::vector<Contact>& ContactFinder::find(const StoneGrid& grid) {
  surfaces_.clear();
  parts_.clear();
  contacts_.clear();
  collect(grid);
  for (const Part& part : parts_) choose(part);
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    return a.cell != b.cell ? before(a.cell, b.cell) : a.seed < b.seed;
  });
  return contacts_;
}

}  // namespace talus::rocks
