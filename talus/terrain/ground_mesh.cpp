#include "talus/terrain/ground_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "talus/terrain/ground_deviation.h"
#include "talus/terrain/ground_skirt.h"
#include "talus/terrain/ground_surface.h"
#include "talus/terrain/terrain_field.h"

namespace talus {
namespace {

using ground::Lattice;
using ground::Surface;

constexpr double kLinesMax = 1 << 28;
constexpr double kLevelsMax = 1 << 30;
constexpr double kSkirtMin = 1e-3;    // in metres: what is shorter has no area in float
constexpr double kSkirtShare = 0.05;  // of the terrain's longer side

// Cells along one axis.
int cells_along(int columns, double spacing, double cell) {
  return static_cast<int>(std::max(1.0, std::round(columns * spacing / cell)));
}

// First of `cells` cells that begins at or beyond a column.
int first_cell(int column, int columns, int cells) {
  return static_cast<int>((std::int64_t{column} * cells + columns - 1) / columns);
}

Lattice make_lattice(const TerrainGrid& grid, double cell, const ColumnArea& area) {
  const double lines = (grid.nx * grid.cell / cell + 2) * (grid.ny * grid.cell / cell + 2);
  if (lines > kLinesMax)
    throw usage_error(
        fmt::format("a ground mesh with cells of {} m needs {:.3g} lines, more than {}; choose "
                    "cells of {:.3g} m or more",
                    cell, lines, kLinesMax, cell * std::sqrt(lines / kLinesMax)));
  if (2 * kStepsMax * grid.step / cell > kLevelsMax)
    throw usage_error(
        fmt::format("cells of {} m are too small for steps of {} m; choose {:.3g} m "
                    "or more",
                    cell, grid.step, 2 * kStepsMax * grid.step / kLevelsMax));
  Lattice lattice;
  const int cells_x = cells_along(grid.nx, grid.cell, cell);
  const int cells_y = cells_along(grid.ny, grid.cell, cell);
  lattice.columns_x = static_cast<double>(grid.nx) / cells_x;
  lattice.columns_y = static_cast<double>(grid.ny) / cells_y;
  lattice.steps = cell / grid.step;
  // Half a cell off the floor, since much that is level lies a whole number of metres above it.
  lattice.level_zero = grid.floor + 0.5 * lattice.steps;
  lattice.cell = {lattice.columns_x * grid.cell, lattice.columns_y * grid.cell, cell};
  lattice.center_i = cells_x / 2;
  lattice.center_j = cells_y / 2;
  lattice.i_begin = first_cell(area.x_begin, grid.nx, cells_x);
  lattice.j_begin = first_cell(area.y_begin, grid.ny, cells_y);
  lattice.i_end = first_cell(area.x_end, grid.nx, cells_x);
  lattice.j_end = first_cell(area.y_end, grid.ny, cells_y);
  return lattice;
}

// What sides are made of.
Material first_material(MaterialSet materials) {
  int m = 0;
  while (!materials.contains(static_cast<Material>(m))) ++m;
  return static_cast<Material>(m);
}

}  // namespace

GroundMesh make_ground_mesh(const LayeredTerrain& terrain, const GroundMeshParams& params,
                            Job* job) {
  validate(params);
  if (params.skirt && *params.skirt > 0 && *params.skirt < kSkirtMin)
    throw usage_error(
        fmt::format("ground.skirt = {} m is too short; give 0 to leave the ground open, or "
                    "{} m at least",
                    *params.skirt, kSkirtMin));
  const TerrainGrid& grid = terrain.grid();
  if (params.materials.contains(Material::air) || params.materials == MaterialSet())
    throw usage_error("a ground mesh needs materials other than air");
  const ColumnArea whole{0, 0, grid.nx, grid.ny};
  const ColumnArea area = intersection(params.area.value_or(whole), whole);
  if (area.empty()) throw usage_error("the area to mesh holds no column of the terrain");

  const double cell = params.cell.value_or(grid.cell);
  const TerrainField field(terrain, params.materials,
                           params.sigma.value_or(std::max(cell, grid.cell)));
  const Lattice lattice = make_lattice(grid, cell, area);
  GroundMesh ground;
  ground.origin = {grid.origin_x + lattice.center_i * lattice.cell.x,
                   grid.origin_y + lattice.center_j * lattice.cell.y,
                   lattice.level_zero * grid.step};
  if (lattice.i_begin == lattice.i_end || lattice.j_begin == lattice.j_end) return ground;

  const double skirt = params.skirt.value_or(kSkirtShare * grid.cell * std::max(grid.nx, grid.ny));
  Surface surface(field, lattice, job);
  if (skirt > 0) {
    const ground::SkirtSize size = ground::largest_skirt(surface);
    ground::check_vertex_count(surface.vertex_count() + size.vertices);
    ground.mesh.positions.reserve(surface.vertex_count() + size.vertices);
    ground.mesh.normals.reserve(surface.vertex_count() + size.vertices);
    ground.mesh.shares.reserve(surface.vertex_count() + size.vertices);
    ground.mesh.triangles.reserve(surface.triangle_count() + size.triangles);
  }
  surface.fill(ground.mesh, job);
  ground.ground_triangles = ground.mesh.triangles.size();
  ground.ground_vertices = ground.mesh.positions.size();
  ground.surface_cells = surface.surface_cells();
  ground.field_samples = surface.field_samples();
  ground.scratch_bytes = surface.bytes();
  const ground::Deviation deviation = ground::deviation_from_tops(surface, field, ground.mesh);
  ground.deviation_max = deviation.max;
  ground.deviation_p99 = deviation.p99;
  ground.deviation_mean = deviation.mean;
  ground.columns_lost = deviation.columns_lost;
  if (skirt > 0 && surface.vertex_count() > 0)
    ground::add_skirt(surface, skirt, params.base, first_material(params.materials), ground.mesh);
  report_progress(job, "ground mesh", 1);
  return ground;
}

}  // namespace talus
