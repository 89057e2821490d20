#include "talus/tools/fill_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "talus/tools/fill_run.h"

namespace talus {
namespace {

// Where a column's axis, followed upward, enters the mesh (turn 1) or leaves it (-1): the first
// step with its center above.
struct AxisCrossing {
  int column;
  Steps step;
  int turn;
};

// The first column or row with its center at `place` or beyond, within a grid of `count`.
int first_from(double place, double origin, double cell, int count) {
  return static_cast<int>(
      std::clamp(std::ceil((place - origin) / cell - 0.5), 0.0, static_cast<double>(count)));
}

// Triangles sorted by the rows of columns whose center lines they cross. All that decides which
// triangle an axis meets is computed once for a vertex or an edge, the same for all triangles
// around it, so that none slips through between two.
class TriangleRows {
 public:
  TriangleRows(const TerrainGrid& grid, const TriangleMesh& mesh) : grid_(grid), mesh_(mesh) {
    vertex_rows_.resize(mesh.positions.size());
    parallel_for(
        vertex_rows_.size(),
        [&](std::size_t v) {
          const double y = mesh.positions[v].y;
          vertex_rows_[v] = first_from(y, grid.origin_y, grid.cell, grid.ny);
        },
        4096);
    first_.assign(static_cast<std::size_t>(grid.ny) + 1, 0);
    for_each_row([&](std::size_t row, std::uint32_t) { ++first_[row + 1]; });
    for (std::size_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
    triangles_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_each_row([&](std::size_t row, std::uint32_t t) { triangles_[next[row]++] = t; });
  }

  // By column, then upward.
  std::vector<AxisCrossing> crossings(int row) const {
    std::vector<AxisCrossing> found;
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t i = first_[r]; i < first_[r + 1]; ++i)
      cross(mesh_.triangles[triangles_[i]], row, found);
    std::sort(found.begin(), found.end(), [](const AxisCrossing& a, const AxisCrossing& b) {
      return std::tie(a.column, a.step) < std::tie(b.column, b.step);
    });
    return found;
  }

 private:
  // Of a triangle's edge and a row's center line.
  struct EdgeCrossing {
    double x = 0, z = 0;
    int column = 0;  // the first with its center beyond
  };

  void for_each_row(auto&& use) const {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle& v = mesh_.triangles[t];
      const auto [low, high] =
          std::minmax({vertex_rows_[v.x], vertex_rows_[v.y], vertex_rows_[v.z]});
      for (int row = low; row < high; ++row) use(static_cast<std::size_t>(row), t);
    }
  }

  EdgeCrossing cross_edge(std::uint32_t a, std::uint32_t b, int row) const {
    const Vec3 p(mesh_.positions[std::min(a, b)]), q(mesh_.positions[std::max(a, b)]);
    const double y = grid_.center(0, row).y;
    const double share = std::clamp((y - p.y) / (q.y - p.y), 0.0, 1.0);
    const double x = std::lerp(p.x, q.x, share);
    return {x, std::lerp(p.z, q.z, share), first_from(x, grid_.origin_x, grid_.cell, grid_.nx)};
  }

  void cross(const Triangle& triangle, int row, std::vector<AxisCrossing>& found) const {
    // Seen from above, a triangle that faces up has its northward edge on the right.
    EdgeCrossing north, south;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      const bool starts_below = vertex_rows_[a] <= row, ends_below = vertex_rows_[b] <= row;
      if (starts_below != ends_below) (starts_below ? north : south) = cross_edge(a, b, row);
    }
    const int turn = south.column < north.column ? -1 : 1;
    const EdgeCrossing &west = turn < 0 ? south : north, &east = turn < 0 ? north : south;
    for (int column = west.column; column < east.column; ++column) {
      const double x = grid_.center(column, 0).x;
      const double share = std::clamp((x - west.x) / (east.x - west.x), 0.0, 1.0);
      found.push_back({column, step_above(std::lerp(west.z, east.z, share)), turn});
    }
  }

  Steps step_above(double z) const {
    const double step = std::ceil(z / grid_.step - 0.5);
    return static_cast<Steps>(std::clamp<double>(step, grid_.floor, kStepsMax));
  }

  TerrainGrid grid_;
  const TriangleMesh& mesh_;
  std::vector<int> vertex_rows_;    // the first whose center line is not south of the vertex
  std::vector<std::size_t> first_;  // of each row, and one past the last
  std::vector<std::uint32_t> triangles_;
};

void check_input(const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  for (const Vec3f& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw usage_error(fmt::format("fill_mesh: the vertex ({}, {}, {}) is nowhere; give numbers",
                                    p.x, p.y, p.z));
  for (const Triangle& t : mesh.triangles)
    if (t.x >= count || t.y >= count || t.z >= count)
      throw usage_error(
          fmt::format("fill_mesh: the triangle ({}, {}, {}) is of vertices that are not there; "
                      "there are {}",
                      t.x, t.y, t.z, count));
}

}  // namespace

Booking fill_mesh(LayeredTerrain& terrain, const TriangleMesh& mesh, const FillMeshParams& params,
                  Job* job) {
  check_input(mesh);
  TerrainGrid grid = terrain.grid();
  grid.origin_x -= params.origin.x;
  grid.origin_y -= params.origin.y;
  const TriangleRows rows(grid, mesh);
  std::vector<std::vector<AxisCrossing>> crossings(static_cast<std::size_t>(grid.ny));
  parallel_for(crossings.size(), [&](std::size_t row) {
    check_cancelled(job);
    crossings[row] = rows.crossings(static_cast<int>(row));
  });

  const Box3 box = bounds(mesh);
  return terrain.edit(
      grid.columns_within(Vec2(box.min), Vec2(box.max)),
      [&](int x, int y, ColumnEditor& column) {
        const auto& row = crossings[static_cast<std::size_t>(y)];
        auto at = std::lower_bound(row.begin(), row.end(), x,
                                   [](const AxisCrossing& c, int i) { return c.column < i; });
        int winding = 0;
        Steps bottom = 0;
        for (; at != row.end() && at->column == x; ++at) {
          const bool was_inside = winding > 0, is_inside = (winding += at->turn) > 0;
          if (!was_inside && is_inside) bottom = at->step;
          if (was_inside && !is_inside)
            fill_run(column, bottom, at->step, params.material, params.replaces);
        }
      },
      job);
}

}  // namespace talus
