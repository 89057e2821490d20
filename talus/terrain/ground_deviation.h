// How far the ground mesh is from the columns. For the ground mesh's own files.
#pragma once

#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/ground_surface.h"
#include "talus/terrain/terrain_field.h"

namespace talus::ground {

struct Deviation {
  double max = 0;
  double p99 = 0;
  double mean = 0;
  std::uint64_t columns_lost = 0;
};

// Distance between the top of a column's uppermost material of the field, in its middle, and the
// plane of the nearest triangle above or below: the largest, what 99 % do not exceed, and the mean
// over the columns of the lattice that have both; at most sigma where just the edge of something
// thick is cut off. Columns whose top has no triangle within two sigmas of height, since the field
// is below 0 there, are counted as lost instead.
Deviation deviation_from_tops(const Surface& surface, const TerrainField& field,
                              const TriangleMesh& mesh);

}  // namespace talus::ground
