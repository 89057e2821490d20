// How the ground mesh stands in the grid of its cells. For the ground mesh's own files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/job.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/field_sampler.h"

namespace talus::ground {

// The grid of cells: vertical lines (i, j) in rows j from the south, horizontal levels k. An area's
// lines have the numbers and places that they have in the whole terrain's grid.
struct Lattice {
  double columns_x = 1, columns_y = 1;  // columns per cell
  double steps = 1;                     // steps per cell
  double level_zero = 0;                // steps
  Vec3 cell{1};                         // metres
  int center_i = 0, center_j = 0;       // line at the origin of the mesh's positions

  int i_begin = 0, j_begin = 0;  // first line
  int i_end = 1, j_end = 1;      // last line, included

  std::size_t line_count_x() const { return static_cast<std::size_t>(i_end - i_begin + 1); }
  std::size_t line_count_y() const { return static_cast<std::size_t>(j_end - j_begin + 1); }

  // Place of a point in the grid, in grid units of the field and in the mesh.
  Vec3 field_point(const Vec3& p) const {
    return {p.x * columns_x, p.y * columns_y, level_zero + p.z * steps};
  }
  Vec3f mesh_point(const Vec3& p) const {
    return Vec3f((p.x - center_i) * cell.x, (p.y - center_j) * cell.y, p.z * cell.z);
  }
};

// A line leaves or enters the inside between `level` and the next, at this fraction of the edge.
struct Crossing {
  std::int32_t level;
  float fraction;
};

// Where the surface crosses the edges of the grid, and the numbers of the vertices there. Lines
// begin inside or outside, all alike; a line's crossings have increasing levels.
class Surface {
 public:
  Surface(const TerrainField& field, const Lattice& lattice, Job* job);

  const Lattice& lattice() const { return lattice_; }
  bool inside_below() const { return inside_below_; }
  std::span<const Crossing> line(int i, int j) const;

  // The vertex of the first crossing of a line, of the first edge upward from (i, j) to (i + 1, j),
  // to (i, j + 1). The next ones of each have the next numbers.
  std::uint32_t first_vertical(int i, int j) const;
  std::uint32_t first_along_x(int i, int j) const;
  std::uint32_t first_along_y(int i, int j) const;

  std::size_t vertex_count() const { return rows_.back().first_vertex; }
  std::size_t triangle_count() const { return rows_.back().first_triangle; }
  // Of the cells between the rows of lines j and j + 1.
  std::span<const Triangle> triangles(const TriangleMesh& mesh, int j) const;

  std::uint64_t surface_cells() const { return surface_cells_; }
  std::uint64_t field_samples() const { return field_samples_; }
  std::size_t bytes() const;

  // Sizes the mesh's vectors and fills them.
  void fill(TriangleMesh& mesh, Job* job);

 private:
  struct Line {
    std::uint32_t first_crossing;  // of the row's
    std::uint32_t first_vertex;    // counted from the row's first, as below
    std::uint32_t first_along_y;
  };
  struct Row {
    std::vector<Crossing> crossings;
    std::vector<Line> lines;  // and one past the last
    std::uint64_t vertices = 0, triangles = 0, cells = 0, samples = 0;
    std::uint64_t first_vertex = 0, first_triangle = 0;
  };
  struct Filler;

  const Row& row(int j) const { return rows_[static_cast<std::size_t>(j - lattice_.j_begin)]; }
  const Line& at(int i, int j) const {
    return row(j).lines[static_cast<std::size_t>(i - lattice_.i_begin)];
  }
  void find_crossings(int j, FieldSampler& sampler);
  void count(int j);
  void number_rows();

  const TerrainField* field_;
  Lattice lattice_;
  bool inside_below_;
  std::vector<Row> rows_;  // and one past the last
  std::uint64_t surface_cells_ = 0, field_samples_ = 0;
};

// Throws `Error` (job) if there are more vertices than indices can tell apart.
void check_vertex_count(std::uint64_t count);

}  // namespace talus::ground
