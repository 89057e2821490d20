// Sides and base of the ground mesh. For the ground mesh's own files.
#pragma once

#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/ground_surface.h"

namespace talus::ground {

// Closes the mesh of a surface with sides in the planes of the lattice's border,
// down to `depth` metres below the lowest cell that the surface crosses, and there with a base if
// `base`; what begins outside needs neither foot nor base. The sides fit the surface's border
// vertex by vertex and get few triangles where they are whole. All of it shows one material.
void add_skirt(const Surface& surface, double depth, bool base, Material material,
               TriangleMesh& mesh);

// What `add_skirt` adds at most.
struct SkirtSize {
  std::size_t vertices;
  std::size_t triangles;
};
SkirtSize largest_skirt(const Surface& surface);

}  // namespace talus::ground
