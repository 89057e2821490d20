// Exact Voronoi cells of as many seeds as a tile set has stones: isotropic and in one arrangement
// only, where a tile set has weights, axes and every arrangement.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "talus/base/hash.h"

namespace talus {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cell = CGAL::Triangulation_cell_base_with_info_3<Kernel::Point_3, Kernel>;  // and its corner
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel,
    CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                         CGAL::Delaunay_triangulation_cell_base_3<Kernel, Cell>>>;

// One seed in each unit cell of a cube, until there are enough.
std::vector<Kernel::Point_3> seeds(int count) {
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  std::vector<Kernel::Point_3> result;
  for (int i = 0; i < count; ++i) {
    const auto draw = [&](int k) { return uniform(hash(1, Purpose::seed_position, i, k)); };
    result.emplace_back(i % side + draw(0), i / side % side + draw(1), i / (side * side) + draw(2));
  }
  return result;
}

// The cells' corners, and the polygons between two cells.
void cells_cgal(benchmark::State& state) {
  const std::vector<Kernel::Point_3> points = seeds(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    Delaunay delaunay(points.begin(), points.end());
    for (auto cell = delaunay.finite_cells_begin(); cell != delaunay.finite_cells_end(); ++cell)
      cell->info() = delaunay.dual(cell);
    std::vector<Kernel::Point_3> polygons;
    for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
      auto cell = delaunay.incident_cells(*edge);
      const auto first = cell;
      do {
        if (!delaunay.is_infinite(cell)) polygons.push_back(cell->info());
      } while (++cell != first);
    }
    benchmark::DoNotOptimize(polygons.data());
  }
}
BENCHMARK(cells_cgal)->Arg(7382)->ArgName("stones")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
