// What a cross section passes through on its way along a path.
#pragma once

#include <span>
#include <vector>

#include "talus/mesh/triangle_mesh.h"

namespace talus {

// A cross section: an outline in the plane through `at` that is perpendicular to `along`. `along`
// and `up` are unit vectors at right angles; x of the outline is to the right of `along`, y up.
struct TubeRing {
  Vec3 at{0};
  Vec3 along{0};
  Vec3 up{0};
  std::vector<Vec2> outline;  // counterclockwise as one looks along
};

// The closed surface of the solid between rings, corresponding points joined from each ring to the
// next; level with the first and the last ring at its ends, or, if it is a `loop`, from the last to
// the first. It faces outward. Where a path bends more tightly than its rings are wide, each is cut
// off where the plane of the next has passed it, so that nothing turns inside out; together they
// leave out nothing that is at right angles to the nearest part of the path. At least two rings, of
// equally many points, at least three.
TriangleMesh swept_tube(std::span<const TubeRing> rings, bool loop);

// Beyond the middle of a bend that is tighter than its rings are wide the parts of the tube before
// and after it only touch, and come apart if its surface is deformed. Where there are such bends,
// parts of the solid that overlap both: slabs on both sides of their tightest rings, closed.
std::vector<TriangleMesh> slabs_in_bends(std::span<const TubeRing> rings, bool loop,
                                         double half_thickness);

}  // namespace talus
