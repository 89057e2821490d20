// Rounding a stone where it is exposed, not where it touches another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/rocks/contacts.h"

namespace talus::rocks {

// Spheroidal weathering [Beardall2007] of one stone, damped near its contacts as in
// [Peytavie2009] section 5. Every step takes from each voxel that shares a face with the outside an
// amount proportional to its exposure, the weighted number of its 26 neighbors that are outside, so
// that edges wear faster than faces and corners faster than edges. Integers throughout.
class Weathering {
 public:
  Weathering(const TileParams& params, int voxels_per_cell);

  // Share of matter left in each voxel of the grid, smoothed over the stone's own voxels: 1 inside,
  // 0 where all is gone; meaningless in other stones' voxels.
  std::span<const float> wear(const StoneGrid& grid, std::span<const Contact> contacts);

 private:
  void start(const StoneGrid& grid, std::span<const Contact> contacts);
  bool shares_face_with_outside(const StoneGrid& grid, std::size_t i) const;
  void expose(const OwnVoxel& voxel);
  std::int32_t damping(const Int3& voxel) const;
  void step(const StoneGrid& grid);
  void smooth(const StoneGrid& grid);

  int steps_;
  std::int32_t rate_;  // taken in one step from a voxel of an open flat face
  double radius_half_voxels_;
  double blend_half_voxels_;

  std::vector<Int3> contact_faces_;
  std::vector<std::int32_t> left_;      // matter, kFull at first
  std::vector<std::int32_t> damping_;   // of exposed voxels
  std::vector<std::uint8_t> foreign_;   // weights of the neighbors that belong to other stones
  std::vector<std::uint8_t> exposure_;  // weights of the neighbors that are outside
  std::vector<std::uint8_t> is_exposed_;
  std::vector<OwnVoxel> exposed_;
  std::vector<OwnVoxel> emptied_;
  std::vector<std::int32_t> smoothed_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::int32_t> words_;
  std::vector<float> result_;
};

}  // namespace talus::rocks
