#include "talus/render/projection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace talus {

namespace {

constexpr int kMargin = 8;  // texels around what a light map shows, so that its rim stays lit
constexpr double kLeastDistance = 0.005;  // of the farthest: what is nearer shares its light map
constexpr double kLengthening = 4;        // of what the next light map shows

// Matrix with these rows.
glm::dmat4 rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z,
                const glm::dvec4& w) {
  return glm::transpose(glm::dmat4(x, y, z, w));
}

// Right, up and toward the light.
struct LightAxes {
  Vec3 x, y, z;

  explicit LightAxes(const Vec3& light) : z(light) {
    x = glm::normalize(
        glm::cross(std::abs(light.z) > 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, 1), light));
    y = glm::cross(light, x);
  }
  Vec3 operator()(const Vec3& p) const { return {glm::dot(p, x), glm::dot(p, y), glm::dot(p, z)}; }
  Box3 box(std::span<const Ball> balls) const {
    Box3 box;
    for (const Ball& ball : balls) {
      box.include((*this)(ball.center) - ball.radius);
      box.include((*this)(ball.center) + ball.radius);
    }
    return box;
  }
};

LightMap fit_box(const LightAxes& axes, const Box3& box, int texels) {
  const double used = std::max({box.size().x, box.size().y, 1e-6});
  const double texel = used / (texels - 2 * kMargin);
  const double side = texel * texels;
  const double depth = std::max(box.size().z, 1e-6) + 4 * texel;
  const Vec3 middle = box.center();
  return {.map_from_view =
              rows(glm::dvec4(axes.x / side, 0.5 - middle.x / side),
                   glm::dvec4(axes.y / side, 0.5 - middle.y / side),
                   glm::dvec4(axes.z / depth, 0.5 - middle.z / depth), glm::dvec4(0, 0, 0, 1)),
          .texel = texel};
}

}  // namespace

glm::dmat4 clip_from_view(const Camera& camera, double near_plane) {
  const auto axis = [&](const Vec3& a) {
    const Vec3 scaled = a / glm::dot(a, a);
    return glm::dvec4(scaled, -glm::dot(scaled, camera.eye));
  };
  return rows(axis(camera.right), axis(camera.up), glm::dvec4(0, 0, 0, near_plane),
              axis(camera.forward));
}

glm::dmat4 clip_from_view(const LightMap& map) {
  return rows({2, 0, 0, -1}, {0, 2, 0, -1}, {0, 0, 1, 0}, {0, 0, 0, 1}) * map.map_from_view;
}

LightMap fit_light(std::span<const Ball> balls, const Vec3& light, int texels) {
  const LightAxes axes(light);
  return fit_box(axes, axes.box(balls), texels);
}

std::vector<LightMap> fit_sun(std::span<const Ball> balls, const Vec3& sun, const Camera& camera,
                              int texels, int count) {
  const LightAxes axes(sun);
  const Box3 all = axes.box(balls);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0;
  for (const Ball& ball : balls) {
    const double away = glm::dot(ball.center - camera.eye, camera.forward);
    nearest = std::min(nearest, away - ball.radius);
    farthest = std::max(farthest, away + ball.radius);
  }
  nearest = std::max(nearest, kLeastDistance * farthest);

  // What lies between the eye and a distance, as a box around the corners of that part of the view.
  std::vector<LightMap> maps;
  for (double far = kLengthening * nearest;
       far * kLengthening < 1.5 * farthest && static_cast<int>(maps.size()) + 1 < count;
       far *= kLengthening) {
    Box3 part;
    for (const double away : {0.0, far})
      for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
          part.include(
              axes(camera.eye + away * (camera.forward + x * camera.right + y * camera.up)));
    part.min = glm::max(part.min, all.min);
    part.max = glm::min(part.max, all.max);
    part.min.z = all.min.z;
    part.max.z = all.max.z;
    if (!part.empty()) maps.push_back(fit_box(axes, part, texels));
  }
  maps.push_back(fit_box(axes, all, texels));
  return maps;
}

std::array<Vec3, kSkyDirections> sky_directions() {
  // A golden spiral, down from the zenith in steps that a stride of 5 spreads.
  std::array<Vec3, kSkyDirections> directions;
  for (int i = 0; i < kSkyDirections; ++i) {
    const int order = 5 * i % kSkyDirections;
    const double z = (order + 0.5) / kSkyDirections;
    const double turn = 2 * std::numbers::pi * (std::numbers::phi - 1) * order;
    const double r = std::sqrt(1 - z * z);
    directions[static_cast<std::size_t>(i)] = {r * std::cos(turn), r * std::sin(turn), z};
  }
  return directions;
}

}  // namespace talus
