// Rounding a stone where it is exposed, not where it touches another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/rocks/damping.h"
#include "talus/rocks/variation.h"

namespace talus::rocks {

// Spheroidal weathering [Beardall2007] of one stone, damped near its contacts. Every step takes
// from each voxel that shares a face with the outside an amount proportional to its exposure, the
// weighted number of its 26 neighbors that are outside, so that edges wear faster than faces and
// corners faster than edges. Then, as far as it is to be round, its surface moves inward as fast as
// it is curved, so that faces stay while edges and corners go: matter is blurred, sharpened again
// and never grows ([Merriman1992]). Integers throughout.
class Weathering {
 public:
  Weathering(const TileParams& params, int voxels_per_cell);

  // Share of matter left in each voxel of the grid, smoothed over the stone's own voxels: 1 inside,
  // 0 where all is gone; meaningless in other stones' voxels.
  std::span<const float> wear(const StoneGrid& grid, std::span<const Contact> contacts);

 private:
  void start(const StoneGrid& grid, std::span<const Contact> contacts);
  void erode(const StoneGrid& grid);
  void set_rates(const StoneGrid& grid, unsigned rate);
  void find_exposure(const StoneGrid& grid);
  void find_surface(const StoneGrid& grid);
  void step(const StoneGrid& grid);
  void round(const StoneGrid& grid);
  void round_step(const StoneGrid& grid, int weight);
  void smooth(const StoneGrid& grid);

  // For stones alone in their cells, in voxels and steps.
  double depth_;
  double rounding_;
  Damping damping_;
  Variation variation_;

  std::vector<std::uint16_t> left_;       // matter
  std::vector<std::uint16_t> shares_;     // of weathering, see Damping
  std::vector<std::uint16_t> rates_;      // taken in one step for each weight of exposure
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
