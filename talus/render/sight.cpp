#include "talus/render/sight.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace talus {

namespace {

double at(const glm::dvec4& plane, const Vec3& p) { return glm::dot(Vec3(plane), p) + plane.w; }

}  // namespace

Sight::Sight(const glm::dmat4& clip_from_view, double samples) : samples_(samples) {
  const glm::dmat4 rows = glm::transpose(clip_from_view);
  planes_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
             rows[3] - rows[2]};
  for (glm::dvec4& plane : planes_) plane /= glm::length(Vec3(plane));
  w_ = rows[3];
  w_slope_ = glm::length(Vec3(w_));
}

bool Sight::sees(const Ball& ball) const {
  // The samples of a picture lie strictly inside; the margin makes up for rounding to float.
  const double margin = ball.radius + 1e-5 * (1 + glm::length(ball.center));
  return std::all_of(planes_.begin(), planes_.end(),
                     [&](const glm::dvec4& plane) { return at(plane, ball.center) >= -margin; });
}

double Sight::samples_across(const Ball& ball) const {
  const double w = at(w_, ball.center) - w_slope_ * ball.radius;
  return 2 * ball.radius * samples_ / std::max(w, 1e-9);
}

}  // namespace talus
