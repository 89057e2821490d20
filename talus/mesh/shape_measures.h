// Size and shape of a solid.
#pragma once

#include <glm/mat3x3.hpp>

#include "talus/mesh/triangle_mesh.h"

namespace talus {

struct ShapeMeasures {
  double volume = 0;
  double area = 0;

  // What it measures along its principal axes of inertia, longest first; the columns of `axes` are
  // unit vectors along them, right-handed.
  Vec3 lengths{0};
  glm::dmat3 axes{1};

  // Of the ball of the same volume.
  double equivalent_diameter() const;
  // Area of that ball's surface over the solid's own ([Wadell1935]): 1 for a ball, else less.
  double sphericity() const;
};

// Of a closed mesh that faces outward and encloses some volume, in its own unit of length.
ShapeMeasures measure_shape(const TriangleMesh& mesh);

}  // namespace talus
