// Rounding a stone where it is exposed, not where it touches another.
#pragma once

#include <array>
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
  // Rates around a contact on a face across an axis: those of voxels from `first` on, relative to
  // the face's lower voxel.
  struct Stencil {
    Int3 first, size;
    std::vector<std::uint16_t> rates;
  };
  Stencil make_stencil(int axis, double rate, double radius, double blend) const;
  void start(const StoneGrid& grid, std::span<const Contact> contacts);
  void damp(const StoneGrid& grid, const Int3& face);
  void expose(const StoneGrid& grid);
  void step(const StoneGrid& grid);
  void smooth(const StoneGrid& grid);

  int steps_;
  std::uint16_t rate_;                   // taken in one step for each weight of exposure
  std::array<Stencil, 3> near_contact_;  // per axis

  std::vector<std::uint16_t> left_;  // matter
  std::vector<std::uint16_t> rates_;
  std::vector<std::uint8_t> outside_;     // 1 where nothing is left
  std::vector<std::uint8_t> foreign_;     // weights of the neighbors that belong to other stones
  std::vector<std::uint8_t> exposure_;    // weights of the neighbors that are outside
  std::vector<std::uint8_t> at_surface_;  // 1 where a face is shared with the outside
  std::vector<std::uint16_t> smoothed_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> words_;
  std::vector<float> result_;
};

}  // namespace talus::rocks
