#include "talus/rocks/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "talus/base/hash.h"

namespace talus::rocks {
namespace {

bool before(const Int3& a, const Int3& b) {
  return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
}

// Orders stones by cell (z, y, x), then seed.
std::uint64_t name_of(const Int3& cell, std::uint16_t seed) {
  const auto place = [](int coordinate) {
    return static_cast<std::uint64_t>(coordinate + (1 << 15)) & 0xffff;
  };
  return place(cell.z) << 48 | place(cell.y) << 32 | place(cell.x) << 16 | seed;
}

}  // namespace

// The surface to one neighbor may lie in several blocks.
void ContactFinder::collect(const StoneGrid& grid) {
  for (const StoneGrid::Piece& piece : grid.pieces()) {
    if (!piece.self) continue;
    for (const BlockPatches::Side& side : piece.block->patches.of(*piece.self)) {
      const Patch& patch = piece.block->patches.patches[side.patch];
      const Party& other = patch.parties[side.other];
      const Int3 cell = other.cell + piece.cells;
      const std::uint64_t name = name_of(cell, other.seed);
      const auto i =
          static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
      if (i == names_.size()) {
        names_.push_back(name);
        contacts_.push_back({.cell = cell, .seed = other.seed});
        surfaces_.push_back({});
      }
      const auto faces = std::int64_t{patch.end_face - patch.first_face};
      surfaces_[i].faces += faces;
      surfaces_[i].sum += patch.sum + 2 * faces * glm::i64vec3(piece.offset);
      parts_.push_back({&piece, &patch, i});
    }
  }
}

// The nearest to `near` is nearly the one.
void ContactFinder::choose(const Part& part) {
  Contact& contact = contacts_[part.contact];
  Surface& surface = surfaces_[part.contact];
  const auto& faces = part.piece->block->patches.faces;
  const std::size_t first = part.patch->first_face, count = part.patch->end_face - first;
  const std::int16_t *const x = &faces[0][first], *const y = &faces[1][first],
                            *const z = &faces[2][first];
  const Int3 from_near = 2 * part.piece->offset - surface.near;
  const auto offset = [&](std::size_t k) { return Int3(x[k], y[k], z[k]) + from_near; };
  distances2_.resize(count);
  int* const distances2 = distances2_.data();
  int least = surface.least2;
  for (std::size_t k = 0; k < count; ++k) {
    const Int3 at = offset(k);
    distances2[k] = at.x * at.x + at.y * at.y + at.z * at.z;
    least = std::min(least, distances2[k]);
  }
  surface.least2 = least;

  // The middle is at most 0.87 from `near`, so that the one is not much farther.
  const double farthest = std::sqrt(least) + 1.75;
  const int most = static_cast<int>(farthest * farthest);
  near_.resize(count);
  std::uint32_t* const near = near_.data();
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    near[found] = static_cast<std::uint32_t>(k);
    found += distances2[k] <= most;
  }
  for (const std::uint32_t k : std::span(near, found)) {
    // Up to a constant, the squared distance to the middle times the number of faces.
    const glm::i64vec3 at(offset(k)), to_middle = surface.rest * at;
    const std::int64_t distance =
        surface.faces * distances2[k] - 2 * (to_middle.x + to_middle.y + to_middle.z);
    const Int3 face = surface.near + Int3(at);
    if (distance > surface.best || (distance == surface.best && !before(face, contact.face)))
      continue;
    contact.face = face;
    surface.best = distance;
  }
}

void ContactFinder::find_own_voxels(const StoneGrid& grid) {
  for (Contact& contact : contacts_) {
    const int axis = contact.axis();
    Int3 lower = contact.face - 1;
    --lower[axis];
    contact.own_voxel = lower / 2;  // always even before
    if (!grid.own()[grid.index(contact.own_voxel)]) ++contact.own_voxel[axis];
  }
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
  names_.clear();
  collect(grid);
  for (Surface& surface : surfaces_) {
    for (int axis = 0; axis < 3; ++axis)
      surface.near[axis] =
          static_cast<int>(floor_div(2 * surface.sum[axis] + surface.faces, 2 * surface.faces));
    surface.rest = surface.sum - surface.faces * glm::i64vec3(surface.near);
  }
  for (const Part& part : parts_) choose(part);
  find_own_voxels(grid);
  if (discard_fraction_ > 0) discard(grid);
  std::sort(contacts_.begin(), contacts_.end(), [](const Contact& a, const Contact& b) {
    return name_of(a.cell, a.seed) < name_of(b.cell, b.seed);
  });
  return contacts_;
}

}  // namespace talus::rocks
