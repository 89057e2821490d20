#include "talus/mesh/shape_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace talus {
namespace {

// Integrals over a solid, about some origin.
struct Moments {
  double volume = 0;
  Vec3 first{0};
  glm::dmat3 second{0};  // of x x^T
};

// Each triangle spans a tetrahedron with the origin.
Moments moments(const TriangleMesh& mesh, const Vec3& origin) {
  Moments m;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = Vec3(mesh.positions[t.x]) - origin, b = Vec3(mesh.positions[t.y]) - origin,
               c = Vec3(mesh.positions[t.z]) - origin, sum = a + b + c;
    const double det = glm::dot(a, glm::cross(b, c));
    m.volume += det / 6;
    m.first += det / 24 * sum;
    m.second += det / 120 *
                (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                 glm::outerProduct(sum, sum));
  }
  return m;
}

// Columns are unit eigenvectors of a symmetric matrix, by Jacobi's rotations.
glm::dmat3 eigenvectors(glm::dmat3 s) {
  glm::dmat3 axes(1);
  constexpr int kSweeps = 12;  // converges quadratically; four do for most
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      if (s[p][q] == 0) continue;
      const double theta = (s[q][q] - s[p][p]) / (2 * s[p][q]);
      const double t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
      const double cosine = 1 / std::sqrt(t * t + 1), sine = t * cosine;
      glm::dmat3 rotation(1);
      rotation[p][p] = rotation[q][q] = cosine;
      rotation[q][p] = sine;
      rotation[p][q] = -sine;
      s = glm::transpose(rotation) * s * rotation;
      axes = axes * rotation;
    }
  return axes;
}

double surface_area(const TriangleMesh& mesh) {
  double twice = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t.x]);
    twice += glm::length(glm::cross(Vec3(mesh.positions[t.y]) - a, Vec3(mesh.positions[t.z]) - a));
  }
  return 0.5 * twice;
}

}  // namespace

double ShapeMeasures::equivalent_diameter() const {
  return std::cbrt(6 * volume / std::numbers::pi);
}

double ShapeMeasures::sphericity() const {
  const double diameter = equivalent_diameter();
  return std::numbers::pi * diameter * diameter / area;
}

ShapeMeasures measure_shape(const TriangleMesh& mesh) {
  const Moments m = moments(mesh, Vec3(mesh.positions.front()));
  const Vec3 center = m.first / m.volume;
  const glm::dmat3 axes = eigenvectors(m.second / m.volume - glm::outerProduct(center, center));

  Vec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const Vec3f& p : mesh.positions) {
    const Vec3 along = Vec3(p) * axes;
    low = glm::min(low, along);
    high = glm::max(high, along);
  }
  const Vec3 lengths = high - low;
  std::array order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return lengths[a] > lengths[b]; });
  ShapeMeasures result{.volume = m.volume, .area = surface_area(mesh)};
  for (int i = 0; i < 3; ++i) {
    const int axis = order[static_cast<std::size_t>(i)];
    result.lengths[i] = lengths[axis];
    result.axes[i] = axes[axis];
  }
  result.axes[2] = glm::cross(result.axes[0], result.axes[1]);
  return result;
}

}  // namespace talus
