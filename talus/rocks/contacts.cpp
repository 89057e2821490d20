#include "talus/rocks/contacts.h"

#include <algorithm>
#include <array>

#include "talus/base/hash.h"

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
  Contact& contact = contacts_[part.contact];
  Surface& surface = surfaces_[part.contact];
  const std::int64_t count = surface.faces;
  const glm::i64vec3 twice_sum = std::int64_t{2} * surface.sum;
  const Int3 offset = 2 * part.piece->offset;
  std::int64_t best = surface.best;
  for (const FaceRun& run : part.piece->block->patches.runs_of(*part.patch)) {
    Int3 face = run.middle() + offset;
    // Up to a constant, the squared distance to the middle times the number of faces.
    const std::int64_t across =
        face.y * (count * face.y - twice_sum.y) + face.z * (count * face.z - twice_sum.z);
    if (across + surface.least_along_x > best) continue;
    // Of a row of faces only the two around the middle can be nearest, the first of equals.
    const auto along = [&](std::int64_t x) { return x * (count * x - twice_sum.x); };
    const int last = run.length - 1;
    const int below = std::clamp(static_cast<int>((surface.middle_x - face.x) / 2), 0, last);
    const int above = std::min(below + 1, last);
    const std::int64_t at_below = along(face.x + 2 * below), at_above = along(face.x + 2 * above);
    const int step = at_above < at_below ? above : below;
    const std::int64_t distance = std::min(at_below, at_above) + across;
    if (distance > best) continue;
    face.x += 2 * step;
    if (distance == best && !before(face, contact.face)) continue;
    best = distance;
    contact.face = face;
    contact.own_voxel = run.voxel() + part.piece->offset + Int3(step, 0, 0);
  }
  surface.best = best;
}

void ContactFinder::discard(const StoneGrid& grid) {
  const int period = 2 * grid.layout().period_voxels();
  const Int3 corner = 2 * grid.layout().voxels_per_cell * grid.cell();
  for (Contact& contact : contacts_) {
    Int3 place = contact.face + corner;
    for (int axis = 0; axis < 3; ++axis) place[axis] -= period * floor_div(place[axis], period);
    const std::uint64_t h = hash(0, Purpose::contact_discard, place.x, place.y, place.z);
    contact.discarded = uniform(h) < discard_fraction_;
  }
}

const std::vector<Contact>& ContactFinder::find(const StoneGrid& grid) {
  surfaces_.clear();
  parts_.clear();
  contacts_.clear();
  collect(grid);
  for (Surface& surface : surfaces_) {
    surface.middle_x = static_cast<double>(surface.sum.x) / static_cast<double>(surface.faces);
    // No whole number is nearer to the middle than the middle itself; rounded down.
    surface.least_along_x = -(surface.sum.x * surface.sum.x / surface.faces) - 1;
  }
  for (const Part& part : parts_) choose(part);
  if (discard_fraction_ > 0) discard(grid);
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    return a.cell != b.cell ? before(a.cell, b.cell) : a.seed < b.seed;
  });
  return contacts_;
}

}  // namespace talus::rocks
