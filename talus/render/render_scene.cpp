#include "talus/render/render_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/error.h"

namespace talus {

namespace {

Error not_finite() {
  return usage_error("the scene to draw holds a position that is not a finite number");
}

// Smallest ball about the middle of the box.
Ball local_ball(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {};
  Ball ball{.center = bounds(mesh).center()};
  for (const Vec3f& p : mesh.positions)
    ball.radius = std::max(ball.radius, glm::distance(Vec3(p), ball.center));
  return ball;
}

// Boxes around the mesh's vertices in each cell of a grid of the plan; their corners become balls
// without size.
void add_mesh(const TriangleMesh& mesh, const Vec3& origin, std::vector<Ball>& balls) {
  if (mesh.positions.empty()) return;
  if (!mesh.shares.empty() && mesh.shares.size() != mesh.positions.size())
    throw usage_error(fmt::format("a mesh to draw has {} shares for {} vertices",
                                  mesh.shares.size(), mesh.positions.size()));
  constexpr int kBoxes = 12;
  const Box3 box = bounds(mesh);
  std::array<Box3, kBoxes * kBoxes> boxes;
  const auto cell = [&](double v, double low, double size) {
    return std::clamp(static_cast<int>(kBoxes * (v - low) / std::max(size, 1e-30)), 0, kBoxes - 1);
  };
  for (const Vec3f& p : mesh.positions) {
    if (!std::isfinite(p.x + p.y + p.z)) throw not_finite();
    const int x = cell(p.x, box.min.x, box.size().x), y = cell(p.y, box.min.y, box.size().y);
    boxes[static_cast<std::size_t>(x + kBoxes * y)].include(Vec3(p));
  }
  for (const Box3& part : boxes) {
    if (part.empty()) continue;
    for (int corner = 0; corner < 8; ++corner)
      balls.push_back({.center = origin + Vec3(corner & 1 ? part.max.x : part.min.x,
                                               corner & 2 ? part.max.y : part.min.y,
                                               corner & 4 ? part.max.z : part.min.z)});
  }
}

// From sRGB to the share of light.
float linear(std::uint8_t value) {
  const float v = static_cast<float>(value) / 255;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Vec3f usual_color(SurfaceLook::Pattern pattern) {
  switch (pattern) {
    case SurfaceLook::Pattern::plain:
      return {0.42f, 0.39f, 0.35f};
    case SurfaceLook::Pattern::rock:
      return {0.34f, 0.29f, 0.235f};
    case SurfaceLook::Pattern::sand:
      return {0.42f, 0.325f, 0.215f};
    case SurfaceLook::Pattern::soil:
      return {0.15f, 0.135f, 0.065f};
    case SurfaceLook::Pattern::gravel:
      return {0.25f, 0.225f, 0.19f};
    case SurfaceLook::Pattern::ice:
      return {0.45f, 0.62f, 0.70f};
    case SurfaceLook::Pattern::snow:
      return {0.82f, 0.86f, 0.92f};
  }
  return {};
}

}  // namespace

Vec3f mean_color(const SurfaceLook& look) {
  if (look.images && !look.images->albedo.pixels.empty()) {
    const Image& image = look.images->albedo;
    const auto channels = static_cast<std::size_t>(image.channels);
    Vec3 sum(0);
    for (std::size_t i = 0; i + channels <= image.pixels.size(); i += channels)
      for (int c = 0; c < 3; ++c)
        sum[c] += linear(image.pixels[i + static_cast<std::size_t>(c) % channels]);
    return Vec3f(sum * static_cast<double>(channels) / static_cast<double>(image.pixels.size()));
  }
  return look.color.value_or(usual_color(look.pattern));
}

std::vector<Ball> bounding_balls(const RenderScene& scene) {
  std::vector<Ball> balls;
  if (scene.stones) {
    std::vector<Ball> locals;
    for (const auto& prototype : scene.stones->prototypes) locals.push_back(local_ball(*prototype));
    balls.reserve(scene.stones->instances.size());
    for (const Instance& instance : scene.stones->instances) {
      const Ball& local = locals[instance.prototype];
      balls.push_back({.center = world_from_local(instance, Vec3f(local.center)),
                       .radius = std::abs(instance.scale) * local.radius});
    }
  }
  for (const RenderMesh& part : scene.meshes) add_mesh(*part.mesh, part.origin, balls);
  for (const RenderWater& part : scene.water) add_mesh(*part.mesh, part.origin, balls);
  if (balls.empty())
    balls.push_back({.center = {0, 0, scene.ground.value_or(0) + 0.5}, .radius = 0.5});

  for (const Ball& ball : balls)
    if (!std::isfinite(ball.center.x + ball.center.y + ball.center.z + ball.radius))
      throw not_finite();
  return balls;
}

Box3 bounds(const std::vector<Ball>& balls) {
  Box3 box;
  for (const Ball& ball : balls) {
    box.include(ball.center - ball.radius);
    box.include(ball.center + ball.radius);
  }
  return box;
}

}  // namespace talus
