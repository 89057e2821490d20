// The surface of some materials around a place, column by column, and how it moves when something
// is added to their field.
#pragma once

#include <functional>
#include <vector>

#include "talus/terrain/layered_terrain.h"

namespace talus {

// Where a vertical leaves a material upward (`top`) or enters it.
struct Crossing {
  double z = 0;  // metres
  bool top = false;
};

// A column's part of a ball, and the crossings of its axis there, upward, before and after a
// change.
struct SurfaceMove {
  double low = 0, high = 0;  // metres
  std::vector<Crossing> before, after;
};

// f of `TerrainField` on the axes of the columns that a ball meets, at levels a 32nd of the radius
// apart, linear between; sigma is a half-integer number of columns.
class SurfaceProfiles {
 public:
  SurfaceProfiles(const LayeredTerrain& terrain, const MaterialSet& materials, double sigma,
                  const Vec3& center, double radius);

  // The columns within the grid around those whose axes meet the ball.
  const ColumnArea& area() const { return area_; }

  // Where f and f + `added` are 0, within the ball. `added` takes a height in metres; equal
  // crossings are bit-equal where it is 0 all around.
  SurfaceMove move(int x, int y, const std::function<double(double)>& added) const;

 private:
  static constexpr int kLevels = 65;

  double level(int k) const { return lowest_ + k * spacing_; }
  void add_up(const LayeredTerrain& terrain, const MaterialSet& materials, double sigma);

  TerrainGrid grid_;
  Vec3 center_;
  double radius_;
  double lowest_, spacing_;  // of the levels, metres
  ColumnArea area_;
  std::vector<double> values_;  // kLevels for each column of the area, row by row
};

// Moves the boundaries of bedrock in a column as its surface moves: each with the crossing that is
// nearest to it before, by what that one moves. Where a crossing ends its boundary does, where one
// begins there is a boundary. Nothing outside the ball changes; when carving, bedrock is only taken
// away, else only added.
void move_boundaries(ColumnEditor& column, const SurfaceMove& move, double step, bool carve);

}  // namespace talus
