// The surface of the ground as a mesh.
#pragma once

#include <cstdint>
#include <optional>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

struct GroundMeshParams {
  std::optional<double> cell;   // of none: the column spacing
  std::optional<double> sigma;  // of none: the larger of `cell` and the column spacing
  std::optional<double> skirt;  // of none: a twentieth of the terrain's longer side
  bool base = true;

  MaterialSet materials = kGroundMaterials;
  std::optional<ColumnArea> area;  // only this part of the terrain; all of it by default

  static void describe(auto& p, auto&& field) {
    field(p.cell, Field{.name = "cell",
                        .help = "edge of the mesh's cells, stretched until a whole number of them "
                                "spans the terrain; the column spacing by default",
                        .unit = "m",
                        .min = 1e-3,
                        .max = 1e6});
    field(p.sigma,
          Field{.name = "sigma",
                .help = "half-width of the cube over which the columns' steps are smoothed; "
                        "the larger of mesh cell and column spacing by default",
                .unit = "m",
                .min = 1e-3,
                .max = 1e6});
    field(p.skirt,
          Field{.name = "skirt",
                .help = "how far below the ground's lowest point the sides end that close "
                        "it at the border; 0 leaves it open, by default a twentieth of the "
                        "terrain's longer side",
                .unit = "m",
                .min = 0,
                .max = 1e6});
    field(p.base, Field{.name = "base", .help = "whether the sides are closed from below"});
  }
};

struct GroundMesh {
  // With normals and with shares indexed by material. Positions are relative to `origin`, which
  // depends on the terrain's grid and the cell alone, so that meshes of neighboring areas fit.
  TriangleMesh mesh;
  Vec3 origin{0};

  std::uint64_t ground_triangles = 0;  // come first; those of skirt and base follow
  std::uint64_t ground_vertices = 0;
  std::uint64_t surface_cells = 0;  // that the surface crosses
  std::uint64_t field_samples = 0;  // values and gradients of the field that were computed

  // Distance between the top of a column's uppermost such material, in its middle, and the nearest
  // piece of the mesh above or below, across that piece, over all columns of the area that have
  // both and are not lost: the largest, what 99 % of them do not exceed, and the mean.
  double deviation_max = 0;
  double deviation_p99 = 0;
  double deviation_mean = 0;
  // Those whose top the mesh misses by more than two sigmas, since a wall or slab is too thin
  // there.
  std::uint64_t columns_lost = 0;

  std::size_t scratch_bytes = 0;  // of the lines and crossings kept until the mesh is made
};

// Meshes the surface of `TerrainField` by marching cubes, with the signs of f at the corners of the
// cells and the exact places where it vanishes along their edges. Overhangs, caves and pieces that
// float are all in it; what is thinner than a cell may be missed. The surface has no duplicate
// vertices, is manifold, oriented outward and open at the border of the area only; there `skirt`
// closes the sides and `base` the bottom, unless they are 0 and false: 0 for areas that are to be
// put together. Skirt and base have vertices
// of their own, at equal positions, and show bedrock, or the first of the materials.
//
// Only cells near the surface are looked at. Normals are those of `FieldSampler::normal`, shares
// those of `VisibleShares`. Equal bytes for any number of threads; the ground of an area is, byte
// for byte, that part of the whole.
//
// Throws `Error` (usage) for params out of range, an empty area, a cell so small that the grid has
// more than 2^28 lines or a coordinate more than 2^30 cells, and air among the materials; (job) if
// more than 2^32 - 1 vertices could come out, those of a skirt included; `Cancelled`.
GroundMesh make_ground_mesh(const LayeredTerrain& terrain, const GroundMeshParams& params = {},
                            Job* job = nullptr);

}  // namespace talus
