// Where a picture is taken from.
#pragma once

#include <span>

#include "talus/base/vec.h"
#include "talus/base/view_params.h"
#include "talus/render/render_scene.h"

namespace talus {

// A pinhole camera: the ray through a point of the picture is
// forward + x * right + y * up, with x and y in [-1, 1], y upward.
struct Camera {
  Vec3 eye{0};
  Vec3 forward{0, 1, 0};  // unit
  Vec3 right{1, 0, 0};    // half the picture's width at distance 1
  Vec3 up{0, 0, 1};       // half the picture's height at distance 1
};

// Unit vector toward a place at this compass direction (clockwise from north) and elevation.
Vec3 compass_direction(double azimuth_deg, double elevation_deg);

// Where an overview stands whose elevation is not given, in degrees: with stones alone, and with
// land, which is seen best from higher up.
constexpr double kStonesElevation = 16;
constexpr double kLandElevation = 30;

// Throws `Error` (usage): ranges, an eye without a target or at it, and a camera inside without
// one.
void validate_view(const ViewParams& params);

// The camera of `params`; without an eye, as close as shows all balls, centered, with a margin.
// Throws `Error` (usage) for params that `validate_view` refuses.
Camera make_camera(std::span<const Ball> balls, const ViewParams& params);

}  // namespace talus
