#include "talus/render/render_scene.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/error.h"

namespace talus {

namespace {

// Smallest ball about the middle of the box.
Ball local_ball(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {};
  Ball ball{.center = bounds(mesh).center()};
  for (const Vec3f& p : mesh.positions)
    ball.radius = std::max(ball.radius, glm::distance(Vec3(p), ball.center));
  return ball;
}

}  // namespace

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
  for (const RenderMesh& part : scene.meshes) {
    if (part.mesh->positions.empty()) continue;
    const Box3 box = bounds(*part.mesh);
    for (int corner = 0; corner < 8; ++corner)
      balls.push_back({.center = part.origin + Vec3(corner & 1 ? box.max.x : box.min.x,
                                                    corner & 2 ? box.max.y : box.min.y,
                                                    corner & 4 ? box.max.z : box.min.z)});
  }
  if (balls.empty())
    balls.push_back({.center = {0, 0, scene.ground.value_or(0) + 0.5}, .radius = 0.5});

  for (const Ball& ball : balls)
    if (!std::isfinite(ball.center.x + ball.center.y + ball.center.z + ball.radius))
      throw usage_error("the scene to draw holds a position that is not a finite number");
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
