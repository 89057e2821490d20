#include "talus/io/dressed_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "talus/base/hash.h"

namespace talus {
namespace {

constexpr float kRepeats = 1.3f;  // of the texture per unit
constexpr int kFaces = 6;         // +x, -x, +y, -y, +z, -z

int facing(const TriangleMesh& mesh, const Triangle& t) {
  // Vertex normals vary more calmly than triangles, so that fewer islands come out.
  const Vec3f n = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
  const Vec3f size = glm::abs(n);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (n[axis] < 0);
}

// Seen from outside, u to the right and v down, so that no face shows the texture mirrored.
glm::vec2 projected(const Vec3f& p, int face) {
  switch (face) {
    case 0:
      return {p.y, -p.z};
    case 1:
      return {-p.y, -p.z};
    case 2:
      return {-p.x, -p.z};
    case 3:
      return {p.x, -p.z};
    case 4:
      return {p.x, -p.y};
    default:
      return {p.x, p.y};
  }
}

// How far each vertex stands out of its neighbours: mean sine of the angle between its tangent
// plane and the edges that leave it, positive on edges, negative in hollows.
std::vector<float> convexity(const TriangleMesh& mesh) {
  std::vector<float> sum(mesh.positions.size(), 0), edges(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      const Vec3f edge = mesh.positions[a] - mesh.positions[b];
      const float length = glm::length(edge);
      if (!(length > 0)) continue;
      sum[a] += glm::dot(mesh.normals[a], edge) / length;
      sum[b] -= glm::dot(mesh.normals[b], edge) / length;
      ++edges[a];
      ++edges[b];
    }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (edges[i] > 0) sum[i] /= edges[i];
  return sum;
}

// Whole repeats make no difference; without them coordinates keep small.
void begin_in_first_repeat(std::vector<glm::vec2>& coordinates) {
  glm::vec2 least(std::numeric_limits<float>::max());
  for (const glm::vec2& uv : coordinates) least = glm::min(least, uv);
  for (glm::vec2& uv : coordinates) uv -= glm::floor(least);
}

}  // namespace

Vec3f stone_tint(std::uint64_t seed, std::uint32_t stone) {
  const double light = uniform(hash(seed, Purpose::stone_color, stone, 0), 0.52, 0.98);
  const double warm = uniform(hash(seed, Purpose::stone_color, stone, 1), -0.06, 0.12);
  return Vec3f(Vec3(1 + warm, 1, 1 - warm) * light);
}

DressedMesh dress(const TriangleMesh& mesh, std::uint64_t seed, std::uint32_t stone) {
  TriangleMesh with_normals;
  if (mesh.normals.empty()) {
    with_normals = mesh;
    compute_normals(with_normals);
  }
  const TriangleMesh& source = mesh.normals.empty() ? with_normals : mesh;
  const std::vector<float> convex = convexity(source);
  const Vec3f tint = stone_tint(seed, stone);
  const glm::vec2 offset(uniform(hash(seed, Purpose::texture, stone, 0)),
                         uniform(hash(seed, Purpose::texture, stone, 1)));

  // A vertex becomes one for each face of the box that its triangles look to.
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::array<std::uint32_t, kFaces>> split(source.positions.size());
  for (auto& slots : split) slots.fill(kUnused);
  DressedMesh out;
  out.mesh.triangles.reserve(source.triangles.size());
  for (const Triangle& t : source.triangles) {
    const int face = facing(source, t);
    Triangle dressed;
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& slot = split[t[c]][static_cast<std::size_t>(face)];
      if (slot == kUnused) {
        slot = static_cast<std::uint32_t>(out.mesh.positions.size());
        const Vec3f p = source.positions[t[c]];
        out.mesh.positions.push_back(p);
        out.mesh.normals.push_back(source.normals[t[c]]);
        out.texture_coordinates.push_back(kRepeats * projected(p, face) + offset);
        const float light = std::clamp(1 + 0.8f * convex[t[c]], 0.7f, 1.15f);
        const Vec3f color = glm::clamp(tint * light, 0.0f, 1.0f) * 255.0f + 0.5f;
        out.colors.push_back({static_cast<std::uint8_t>(color.x),
                              static_cast<std::uint8_t>(color.y),
                              static_cast<std::uint8_t>(color.z), 255});
      }
      dressed[c] = slot;
    }
    out.mesh.triangles.push_back(dressed);
  }
  begin_in_first_repeat(out.texture_coordinates);
  return out;
}

}  // namespace talus
