// Where stones touch.
#pragma once

#include <limits>
#include <vector>

#include "talus/rocks/stone_grid.h"

namespace talus::rocks {

// A contact with one neighbor: `face` is the middle of a shared voxel face, in half voxels relative
// to the stone's cell.
struct Contact {
  Int3 cell;  // the neighbor's, relative to the stone's
  std::uint16_t seed;
  Int3 face;
  Int3 own_voxel;          // the stone's voxel behind the face
  bool discarded = false;  // weathering does not spare it

  // Of the face: across it the middle has an even coordinate.
  int axis() const { return face.x % 2 == 0 ? 0 : face.y % 2 == 0 ? 1 : 2; }
  // The neighbor's voxel behind it. The middles of both voxels sum up to twice that of the face.
  Int3 voxel_beyond() const { return face - 1 - own_voxel; }
};

// One contact for every neighbor with shared faces that both stones' colors determine: the face
// nearest to the middle of those faces, in exact integers, the first in order z, y, x of equals.
// The neighbor computes the same face. By hash of the face's place in the period, a share of the
// contacts is discarded; the neighbor discards the same. (The seed of the set moves the faces, and
// so need not be hashed.)
class ContactFinder {
 public:
  explicit ContactFinder(double discard_fraction = 0) : discard_fraction_(discard_fraction) {}

  // By increasing cell (z, y, x), then seed.
  const std::vector<Contact>& find(const StoneGrid& grid);

 private:
  // All faces shared with one neighbor. Their middle is `near` + `rest` / `faces`.
  struct Surface {
    std::int64_t faces = 0;
    glm::i64vec3 sum{0};
    Int3 near{0};
    glm::i64vec3 rest{0};
    // So far: the squared distance of a face from `near`, and of the face chosen from the middle.
    int least2 = std::numeric_limits<int>::max();
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
  };
  // What one block holds of a surface.
  struct Part {
    const StoneGrid::Piece* piece;
    const Patch* patch;
    std::size_t contact;
  };
  void collect(const StoneGrid& grid);
  void choose(const Part& part);
  void find_own_voxels(const StoneGrid& grid);
  void discard(const StoneGrid& grid);

  double discard_fraction_;

  std::vector<Contact> contacts_;
  std::vector<std::uint64_t> names_;  // per contact, of the neighbor
  std::vector<Surface> surfaces_;     // per contact
  std::vector<Part> parts_;
  std::vector<int> distances2_;      // of one part's faces from `near`
  std::vector<std::uint32_t> near_;  // those of them that may be chosen
};

}  // namespace talus::rocks
