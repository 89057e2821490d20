// What a pass of drawing can see, and how finely.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "talus/render/render_scene.h"

namespace talus {

// Lengths are those of the space that the clip matrix starts from.
class Sight {
 public:
  // `samples` is how many samples a unit length spans where w is 1.
  Sight(const glm::dmat4& clip_from_view, double samples);

  // Whether some of the ball may be on the picture; never false for one that is.
  bool sees(const Ball& ball) const;

  // Samples across the ball, or more.
  double samples_across(const Ball& ball) const;

 private:
  std::array<glm::dvec4, 5> planes_;  // unit normals inward: four sides and the near one
  glm::dvec4 w_;                      // clip w as a plane
  double w_slope_ = 0;
  double samples_ = 0;
};

}  // namespace talus
