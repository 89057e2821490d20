// Where stones touch, and how far weathering stays away from there.
#pragma once

#include <vector>

#include "talus/rocks/stone_grid.h"

namespace talus::rocks {

// A contact with one neighbor: `face` is the middle of a shared voxel face, in half voxels relative
// to the stone's cell.
struct Contact {
  Neighbor neighbor;
  Int3 face;
  std::size_t own_voxel;  // the stone's voxel behind the face
};

// One contact for every neighbor with shared faces that both stones' colors determine: the face
// nearest to the middle of those faces, in exact integers, the first in order z, y, x of equals.
// The neighbor computes the same face.
class ContactFinder {
 public:
  const std::vector<Contact>& find(const StoneGrid& grid);

 private:
  struct Patch {
    Neighbor neighbor;
    std::int64_t faces = 0;
    glm::i64vec3 sum{0};
    std::int64_t best = 0;
    bool has_best = false;
    Int3 face{0};
    std::size_t own_voxel = 0;
  };
  struct Face {
    std::size_t patch;
    std::size_t own_voxel;
    Int3 middle;
  };
  std::size_t patch_of(const StoneGrid& grid, std::int32_t tag);
  void collect_faces(const StoneGrid& grid);

  std::vector<Patch> patches_;
  std::vector<std::pair<std::int32_t, std::size_t>> patch_by_tag_;
  std::int32_t last_tag_ = StoneGrid::kUnknown;  // neighboring faces mostly have one tag
  std::size_t last_patch_ = 0;
  std::vector<Face> faces_;
  std::vector<Contact> contacts_;
};

}  // namespace talus::rocks
