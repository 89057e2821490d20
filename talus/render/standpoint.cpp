#include "talus/render/standpoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "talus/render/camera.h"

namespace talus {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr double kEyeHeight = 1.7;
constexpr double kEyeHeightOfScene = 0.06;  // at most this share of half the scene's diagonal
constexpr double kPitchMin = -0.15;         // slope of the view
constexpr double kPitchMax = 0.22;

// The highest surfaces of a scene on a square grid of its plan; `kNothing` where there is none.
class Heights {
 public:
  Heights(const RenderScene& scene, const Box3& box)
      : box_(box), cell_(std::max({box.size().x, box.size().y, 1e-9}) / kCells) {
    heights_.assign(kCells * kCells, kNothing);
    for (const RenderMesh& part : scene.meshes)
      for (const Vec3f& p : part.mesh->positions) raise(part.origin + Vec3(p));
    // Meshes coarser than the grid leave gaps.
    for (int pass = 0; pass < 3; ++pass) fill_gaps();
  }

  double at(double x, double y) const {
    const int i = static_cast<int>((x - box_.min.x) / cell_);
    const int j = static_cast<int>((y - box_.min.y) / cell_);
    return i < 0 || j < 0 || i >= kCells || j >= kCells ? kNothing : heights_[index(i, j)];
  }
  double cell() const { return cell_; }

 private:
  static constexpr int kCells = 256;
  static std::size_t index(int i, int j) { return static_cast<std::size_t>(i + kCells * j); }

  void raise(const Vec3& p) {
    const int i = std::clamp(static_cast<int>((p.x - box_.min.x) / cell_), 0, kCells - 1);
    const int j = std::clamp(static_cast<int>((p.y - box_.min.y) / cell_), 0, kCells - 1);
    heights_[index(i, j)] = std::max(heights_[index(i, j)], p.z);
  }
  void fill_gaps() {
    const std::vector<double> old = heights_;
    for (int j = 1; j + 1 < kCells; ++j)
      for (int i = 1; i + 1 < kCells; ++i)
        if (old[index(i, j)] == kNothing)
          heights_[index(i, j)] = std::max({old[index(i - 1, j)], old[index(i + 1, j)],
                                            old[index(i, j - 1)], old[index(i, j + 1)]});
  }

  Box3 box_;
  double cell_;
  std::vector<double> heights_;
};

// Height of the highest surface at (x, y) not above `limit`; `kNothing` if there is none.
double surface_below(const RenderScene& scene, double x, double y, double limit) {
  double highest = scene.ground && *scene.ground <= limit ? *scene.ground : kNothing;
  for (const RenderMesh& part : scene.meshes) {
    const Vec3 origin = part.origin - Vec3(x, y, 0);
    for (const Triangle& t : part.mesh->triangles) {
      const Vec3 a = origin + Vec3(part.mesh->positions[t.x]);
      const Vec3 b = origin + Vec3(part.mesh->positions[t.y]);
      const Vec3 c = origin + Vec3(part.mesh->positions[t.z]);
      // Barycentric coordinates of the vertical line at (x, y).
      const double u = b.x * c.y - c.x * b.y, v = c.x * a.y - a.x * c.y, w = a.x * b.y - b.x * a.y;
      const double area = u + v + w;
      if (area == 0 || u * area < 0 || v * area < 0 || w * area < 0) continue;
      const double z = (u * a.z + v * b.z + w * c.z) / area;
      if (z <= limit) highest = std::max(highest, z);
    }
  }
  return highest;
}

// How much of the land ahead shows from `eye` between its horizons: over a fan of rays, the visible
// parts of the way, each as large as it looks.
double visible_land(const Heights& heights, const Vec3& eye, const Vec3& forward, double reach,
                    double half_angle) {
  constexpr int kRays = 15;
  double sum = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    const double turn = half_angle * (2.0 * ray / (kRays - 1) - 1);
    const double dx = forward.x * std::cos(turn) - forward.y * std::sin(turn);
    const double dy = forward.x * std::sin(turn) + forward.y * std::cos(turn);
    double steepest = kNothing;
    for (double away = 2 * heights.cell(); away < reach; away += heights.cell()) {
      const double z = heights.at(eye.x + away * dx, eye.y + away * dy);
      if (z == kNothing) continue;
      const double slope = (z - eye.z) / away;
      if (slope > steepest) {
        sum += heights.cell() / (away + 0.05 * reach);
        // What rises above the eye makes a view; what stands right before it blocks one.
        if (steepest != kNothing && away > 0.15 * reach)
          sum += 4 * std::max(0.0, slope - std::max(steepest, 0.0));
        steepest = slope;
      }
    }
  }
  return sum / kRays;
}

}  // namespace

Standpoint find_standpoint(const RenderScene& scene, const ViewParams& params) {
  const std::vector<Ball> balls = bounding_balls(scene);
  const Box3 box = bounds(balls);
  const double radius = 0.5 * glm::length(box.size());
  const double eye_height = std::min(kEyeHeight, kEyeHeightOfScene * radius);
  const auto stand = [&](double x, double y, double limit) {
    double z = surface_below(scene, x, y, limit);
    if (z == kNothing) z = surface_below(scene, x, y, std::numeric_limits<double>::infinity());
    return Vec3(x, y, (z == kNothing ? scene.ground.value_or(box.min.z) : z) + eye_height);
  };
  if (params.eye) return {stand(params.eye->x, params.eye->y, params.eye->z), *params.target};

  const Vec3 middle = box.center();
  const Vec3 back = compass_direction(params.azimuth_deg, 0);
  const Vec3 aside(-back.y, back.x, 0);
  const Heights heights(scene, box);
  const double half_angle = std::atan(std::tan(0.5 * glm::radians(params.field_of_view_deg)) *
                                      params.width / params.height);
  Vec3 best = middle;
  double best_score = kNothing;
  for (double away = 0.30; away <= 0.96; away += 0.06)
    for (double across = -0.36; across <= 0.37; across += 0.06) {
      Vec3 p = middle + 0.5 * box.size() * (away * back + across * aside);
      p.z = heights.at(p.x, p.y);
      if (p.z == kNothing) continue;
      const Vec3 forward = glm::normalize(Vec3(middle.x - p.x, middle.y - p.y, 0));
      const double score = visible_land(heights, p + Vec3(0, 0, eye_height), forward,
                                        away * 0.5 * glm::length(box.size()) * 2, half_angle);
      if (score > best_score) {
        best = p;
        best_score = score;
      }
    }
  // Without land to stand on, before all that there is.
  if (best_score == kNothing) best = middle + 1.9 * radius * back;

  const Vec3 eye = stand(best.x, best.y, std::numeric_limits<double>::infinity());
  const double distance = std::hypot(middle.x - eye.x, middle.y - eye.y);
  const double target_z =
      std::clamp(middle.z, eye.z + kPitchMin * distance, eye.z + kPitchMax * distance);
  return {eye, {middle.x, middle.y, target_z}};
}

}  // namespace talus
