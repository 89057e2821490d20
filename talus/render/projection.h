// How places map to pictures: the camera's, and the depth maps of lights far away.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "talus/render/camera.h"

namespace talus {

// Reversed depth without a far plane: 1 at distance `near_plane`, 0 at infinity.
glm::dmat4 clip_from_view(const Camera& camera, double near_plane);

// A square beam of parallel light. `map_from_view` takes what the map shows into [0, 1]^3; depth is
// 1 where the beam enters the scene and 0 where it leaves.
struct LightMap {
  glm::dmat4 map_from_view{1};
  double texel = 0;  // size of one in the lit space
};

glm::dmat4 clip_from_view(const LightMap& map);

// The smallest beam toward `light` that holds all balls, `texels` on a side.
LightMap fit_light(std::span<const Ball> balls, const Vec3& light, int texels);

// Beams for ever larger parts of what the camera sees, at most `count`; the last holds all balls.
std::vector<LightMap> fit_sun(std::span<const Ball> balls, const Vec3& sun, const Camera& camera,
                              int texels, int count);

// Directions spread evenly over the sky, in an order of which any short run is spread well too.
constexpr int kSkyDirections = 24;
std::array<Vec3, kSkyDirections> sky_directions();

}  // namespace talus
