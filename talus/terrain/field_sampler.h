// Fast access to a terrain's field in one neighborhood after another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "talus/terrain/terrain_field.h"

namespace talus {

// Points with a larger f are inside: so little above 0 that the surface does not move, and enough
// that along walls which halve the cube, where f is 0 but for rounding, all points are outside.
constexpr double kInsideAbove = 1e-9;

// What an interval of the plan covers of the columns that it meets along one axis.
struct ColumnCover {
  double low, high;
  int begin, end;  // columns, also beyond the border

  double length() const { return high - low; }
  double of(int column) const {
    return std::min(column + 1.0, high) - std::max<double>(column, low);
  }
};

// Answers at points in grid units (`TerrainField::grid_from_world`), the same as the field itself.
// Holds the columns around the last place, or those of a larger area loaded in advance: one sampler
// for each thread.
class FieldSampler {
 public:
  explicit FieldSampler(const TerrainField& field);

  const TerrainField& field() const { return *field_; }
  double sigma_columns() const { return sigma_columns_; }
  double sigma_steps() const { return sigma_steps_; }

  double value(const Vec3& g);
  Vec3 gradient(const Vec3& g);

  // Unit vector out of the materials, against the gradient; none where it vanishes. Steps that the
  // cube does not hide tilt the gradient of slopes from side to side. So on those the cube is
  // stretched along z, up to `kStretchMax` times, as far as it meets nothing that faces the other
  // way: for planes of slopes up to 2 (|dz/dx| + |dz/dy|, sigma one column) the normal is
  // exact.
  std::optional<Vec3> normal(const Vec3& g);
  static constexpr double kStretchMax = 3;

  // Heights in steps, increasing, at which the vertical through (x, y) leaves or enters the inside.
  // It begins inside if the materials contain bedrock. Valid until the next call.
  //
  // Along a vertical the area A of the materials in the cube's section is piecewise constant, so
  // f(z) = integral of A over [z - sigma, z + sigma] / sigma - 1 is piecewise linear: the crossings
  // are exact, found in one walk over the layers.
  std::span<const double> vertical_crossings(double x, double y);

  // Share of the way from `g` to `length` columns beyond it along `axis` (0 or 1) at which f first
  // changes between inside and outside: exact too, for the same reason. If it does not, the end
  // with the lesser |f|, 0 or 1.
  double horizontal_crossing(const Vec3& g, int axis, double length);

  // Evaluations of f so far, its gradient's and its pieces' ends included.
  std::uint64_t samples() const { return samples_; }

  // Makes the columns of an area, which may reach beyond the border, ready for all that follows
  // within it.
  void load(const ColumnArea& area);

  // Of a column in the loaded area: what `LayeredTerrain::column` says of the nearest one.
  std::span<const Layer> layers(int x, int y) const { return layers_[loaded_.index(x, y)]; }

  ColumnCover cover_x(double center) const { return cover(center, grid_.nx); }
  ColumnCover cover_y(double center) const { return cover(center, grid_.ny); }

  // Loads what the cube around (x, y) covers, and one column more on each side.
  void need(double x, double y) { need(cover_x(x), cover_y(y)); }

 private:
  // What the materials fill of a column, in steps; endless at an end without surface.
  struct Interval {
    double bottom, top;
  };
  // Of a column along one axis, around an interval of the plan.
  struct ColumnWeight {
    double cover;  // of it by the interval
    double face;   // its part of the interval's upper face less that of the lower one
  };
  struct ColumnWeights {
    int first = 0;      // column
    double length = 0;  // of the interval
    std::vector<ColumnWeight> weights;
  };
  // The intervals of an area's columns.
  struct Block {
    ColumnArea area;
    std::vector<std::uint32_t> first;  // of each column, and one past the last
    std::vector<Interval> intervals;
    std::vector<int> columns;  // of the intervals, along x

    std::size_t index(int x, int y) const {
      return static_cast<std::size_t>(y - area.y_begin) *
                 static_cast<std::size_t>(area.x_end - area.x_begin) +
             static_cast<std::size_t>(x - area.x_begin);
    }
    std::span<const Interval> at(int x, int y) const {
      const std::uint32_t* const begin = &first[index(x, y)];
      return {intervals.data() + begin[0], intervals.data() + begin[1]};
    }
    void begin(const ColumnArea& new_area);
    // The intervals in a part of a row, one past the last as well: they follow one another.
    std::pair<std::uint32_t, std::uint32_t> row(const ColumnWeights& part, int y) const {
      const std::uint32_t* const begin = &first[index(part.first, y)];
      return {begin[0], begin[part.weights.size()]};
    }
    void end_column(int x) {
      columns.resize(intervals.size(), x);
      first.push_back(static_cast<std::uint32_t>(intervals.size()));
    }
  };
  struct Change {
    double z;
    double area;  // by which A grows
  };

  ColumnCover cover(double center, int columns) const;
  static void weigh(const ColumnCover& cover, ColumnWeights& weights);
  void need(const ColumnCover& xs, const ColumnCover& ys);
  void add_intervals(std::span<const Layer> layers);
  void approach(const Vec3& g);
  double room(double z, bool upward) const;
  Vec3 gradient(double z, double half_height);
  void gather_changes(double x, double y);

  const TerrainField* field_;
  TerrainGrid grid_;
  double sigma_columns_;
  double sigma_steps_;

  Block loaded_;
  std::vector<std::span<const Layer>> layers_;  // of the loaded columns
  std::vector<Change> changes_;
  std::vector<double> crossings_;
  std::vector<double> slices_;
  ColumnWeights weights_x_, weights_y_;  // around the place last approached
  std::uint64_t samples_ = 0;
};

}  // namespace talus
