// Polygons in space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// Cuts a polygon, concave or not, into triangles that turn the way it does. The corners, three or
// more, are indices into `positions`, in range. One of more than a thousand corners is cut as if
// convex, and so is what is left of one that crosses itself.
std::vector<Triangle> triangulate(std::span<const std::uint32_t> corners,
                                  std::span<const Vec3> positions);

}  // namespace talus
