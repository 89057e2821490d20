// Triangles sorted into the cells of a regular grid, to find which ones a short segment crosses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/job.h"
#include "talus/base/vec.h"
#include "talus/field/support.h"

namespace talus {

// A box of cubic cells.
struct CellGrid {
  Vec3 origin{0};
  double cell = 1;
  Int3 size{0};

  std::size_t index(const Int3& c) const {
    return static_cast<std::size_t>(c.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(c.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(c.z));
  }
  std::size_t count() const { return index({0, 0, size.z}); }
  Vec3 middle(const Int3& c) const { return origin + cell * (Vec3(c) + 0.5); }
  // The cell that holds a point, or the nearest one.
  Int3 cell_of(const Vec3& p) const;
};

class TriangleGrid {
 public:
  // Every triangle must lie inside the grid.
  TriangleGrid(const CellGrid& cells, std::span<const Vec3> vertices,
               std::span<const Triangle> triangles, Job* job);

  // Triangles that may touch a cell, by increasing index.
  std::span<const std::uint32_t> in_cell(std::size_t c) const {
    return {lists_.data() + first_[c], first_[c + 1] - first_[c]};
  }

  // Triangles among `listed` crossed from front to back, less those crossed from back to front, on
  // the way from one point to another: how the winding number changes. Both ends are understood to
  // be nudged by the same tiny amount, so that no segment runs through an edge or a vertex.
  int crossings(std::span<const std::uint32_t> listed, const Vec3& from, const Vec3& to) const;
  // The same to each of several points.
  void add_crossings(std::span<const std::uint32_t> listed, const Vec3& from,
                     std::span<const Vec3> to, std::span<double> sums) const;

  // Bits of the boxes around the points of a block that triangles among `listed` may touch: neither
  // lies the box wholly on one side of the triangle, nor are their own boxes apart.
  struct Touched {
    std::uint64_t boxes = 0;    // that reach that far
    std::uint64_t meeting = 0;  // and such as meet their neighbors
  };
  Touched touched(std::span<const std::uint32_t> listed, const PointBlock& centers,
                  const Vec3& half) const;

 private:
  void list(const CellGrid& cells, Job* job);
  bool in_front(const Vec3& p, std::uint32_t triangle) const;
  bool passes_through(const Vec3& from, const Vec3& to, std::uint32_t triangle) const;
  bool passes_left(const Vec3& from, const Vec3& to, std::uint32_t a, std::uint32_t b) const;

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Vec3> normals_;  // not of unit length
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> lists_;
};

}  // namespace talus
