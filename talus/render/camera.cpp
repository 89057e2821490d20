#include "talus/render/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace talus {

namespace {

constexpr double kFilledFraction = 0.86;  // of the picture's width or height

// Interval of the picture's plane through the eye that holds all balls, and how far the eye must
// step back for one of its two axes. Each of the two planes that bound the view on this axis is
// pushed outward until every ball is inside; they meet in a line, on which the eye must lie.
struct AxisFit {
  double offset;  // of the eye along the axis
  double back;    // of the eye against the view direction
};

AxisFit fit_axis(std::span<const Ball> balls, const Vec3& origin, const Vec3& axis,
                 const Vec3& forward, double tangent) {
  const double slope_length = std::hypot(1.0, tangent);
  double high = -std::numeric_limits<double>::infinity();
  double low = high;
  for (const Ball& ball : balls) {
    const Vec3 p = ball.center - origin;
    const double across = glm::dot(p, axis);
    const double widening = ball.radius * slope_length - tangent * glm::dot(p, forward);
    high = std::max(high, across + widening);
    low = std::max(low, widening - across);
  }
  return {.offset = 0.5 * (high - low), .back = 0.5 * (high + low) / tangent};
}

}  // namespace

void validate_view(const ViewParams& params) {
  validate(params, "view");
  if (params.eye.has_value() != params.target.has_value())
    throw usage_error("view.eye and view.target must be given together");
  if (params.camera == CameraPreset::inside && !params.eye)
    throw usage_error("view.camera = \"inside\" needs view.eye and view.target");
  if (params.eye && *params.eye == *params.target)
    throw usage_error("view.eye is at view.target; it must look from somewhere else");
}

Vec3 compass_direction(double azimuth_deg, double elevation_deg) {
  const double azimuth = glm::radians(azimuth_deg);
  const double elevation = glm::radians(elevation_deg);
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

Camera make_camera(std::span<const Ball> balls, const ViewParams& params) {
  validate_view(params);
  const double tangent_y = std::tan(0.5 * glm::radians(params.field_of_view_deg));
  const double tangent_x = tangent_y * params.width / params.height;

  Camera camera;
  camera.forward = params.eye ? glm::normalize(*params.target - *params.eye)
                              : -compass_direction(params.azimuth_deg,
                                                   params.elevation_deg.value_or(kStonesElevation));
  // Straight up or down, north is the top of the picture.
  const bool vertical = std::abs(camera.forward.z) > 0.999999;
  const Vec3 top = vertical ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 right = glm::normalize(glm::cross(camera.forward, top));
  const Vec3 up = glm::cross(right, camera.forward);
  camera.right = tangent_x * right;
  camera.up = tangent_y * up;
  if (params.eye) {
    camera.eye = *params.eye;
    return camera;
  }

  const Vec3 origin = balls.front().center;
  const AxisFit x = fit_axis(balls, origin, right, camera.forward, kFilledFraction * tangent_x);
  const AxisFit y = fit_axis(balls, origin, up, camera.forward, kFilledFraction * tangent_y);
  const Vec3 fitted =
      origin + x.offset * right + y.offset * up - std::max(x.back, y.back) * camera.forward;

  // Zooming moves the eye toward the middle of what it sees.
  double middle = 0;
  for (const Ball& ball : balls) middle += glm::dot(ball.center - fitted, camera.forward);
  middle /= static_cast<double>(balls.size());
  camera.eye = fitted + middle * (1 - 1 / params.zoom) * camera.forward;
  return camera;
}

}  // namespace talus
