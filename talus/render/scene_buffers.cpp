#include "talus/render/scene_buffers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include "talus/base/hash.h"

namespace talus {

namespace {

// Size of a stone, or of a pebble on bare ground, where no stone tells: share of the scene.
constexpr double kStoneRadiusWithoutStones = 0.04;

struct GpuVertex {
  Vec3f position;
  std::uint32_t normal;  // 10 bits per axis
};

// As `Instance` in shaders/common.glsl.
struct GpuInstance {
  Vec3f position;
  float scale;
  glm::vec4 rotation;  // x, y, z, w
  Vec3f albedo;
  float texture_scale;  // texture units per view unit; 0: a mesh in one color
  Vec3f texture_offset;
  std::uint32_t id;  // from 1
};

struct DrawCommand {  // as OpenGL defines it
  std::uint32_t count;
  std::uint32_t instance_count;
  std::uint32_t first_index;
  std::int32_t base_vertex;
  std::uint32_t base_instance;
};

struct MeshRange {
  std::uint32_t count;
  std::uint32_t first_index;
  std::int32_t base_vertex;
};

struct Geometry {
  std::vector<GpuVertex> vertices;
  std::vector<std::uint32_t> indices;

  MeshRange add(const TriangleMesh& mesh) {
    if (mesh.normals.size() != mesh.positions.size()) {
      TriangleMesh shaded = mesh;
      compute_normals(shaded);
      return add(shaded);
    }
    const MeshRange range = {static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                             static_cast<std::uint32_t>(indices.size()),
                             static_cast<std::int32_t>(vertices.size())};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      vertices.push_back(
          {mesh.positions[i], glm::packSnorm3x10_1x2(glm::vec4(mesh.normals[i], 0))});
    for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    return range;
  }
};

double random(std::size_t stone, int what) {
  return uniform(hash(0, Purpose::texture, stone, what));
}

// A stone's own color: a mixture of two kinds of rock, lighter or darker than its neighbours.
Vec3f stone_albedo(std::size_t stone) {
  static constexpr std::array<Vec3f, 7> kRocks = {
      Vec3f(0.420f, 0.340f, 0.245f),   // sandstone
      Vec3f(0.330f, 0.300f, 0.258f),   // weathered limestone
      Vec3f(0.470f, 0.420f, 0.340f),   // pale limestone
      Vec3f(0.215f, 0.212f, 0.212f),   // basalt
      Vec3f(0.300f, 0.305f, 0.305f),   // granite
      Vec3f(0.360f, 0.250f, 0.175f),   // rusty
      Vec3f(0.325f, 0.300f, 0.245f)};  // graywacke
  const auto pick = [&](int what) {
    return kRocks[static_cast<std::size_t>(random(stone, what) * kRocks.size())];
  };
  const auto share = static_cast<float>(random(stone, 2));
  const auto value = static_cast<float>(0.72 + 0.48 * random(stone, 3));
  return value * glm::mix(pick(0), pick(1), share);
}

}  // namespace

SceneBuffers::SceneBuffers(const RenderScene& scene) : balls_(bounding_balls(scene)) {
  const Box3 box = bounds(balls_);
  center_ = box.center();
  // A lone point has no size; a millionth of a metre keeps the division sound.
  radius_ = std::max(0.5 * glm::length(box.size()), 1e-6);
  for (Ball& ball : balls_)
    ball = {.center = view_from_world(ball.center), .radius = ball.radius / radius_};
  if (scene.ground) ground_ = (*scene.ground - center_.z) / radius_;

  const std::size_t stones = scene.stones ? scene.stones->instances.size() : 0;
  stone_radius_ = kStoneRadiusWithoutStones;
  if (stones > 0) {
    std::vector<double> radii;
    for (std::size_t i = 0; i < stones; ++i) radii.push_back(balls_[i].radius);
    const auto median = radii.begin() + static_cast<std::ptrdiff_t>(stones / 2);
    std::nth_element(radii.begin(), median, radii.end());
    stone_radius_ = std::clamp(*median, 1e-6, 0.6);
  }

  Geometry geometry;
  std::vector<GpuInstance> instances;
  std::vector<DrawCommand> commands;

  // One command per run of stones with the same mesh. The grain of a stone's texture follows its
  // size halfway: a boulder shows more of it than a cobble, yet neither is smooth or noise.
  std::vector<MeshRange> ranges;
  if (stones > 0)
    for (const auto& prototype : scene.stones->prototypes)
      ranges.push_back(geometry.add(*prototype));
  for (std::size_t i = 0; i < stones; ++i) {
    const Instance& stone = scene.stones->instances[i];
    const auto id = static_cast<std::uint32_t>(i);
    if (i == 0 || stone.prototype != scene.stones->instances[i - 1].prototype) {
      const MeshRange& range = ranges[stone.prototype];
      commands.push_back({range.count, 0, range.first_index, range.base_vertex, id});
    }
    ++commands.back().instance_count;
    const double grain = std::sqrt(std::max(balls_[i].radius, 1e-9) * stone_radius_);
    const Quat& q = stone.rotation;
    instances.push_back({.position = Vec3f(view_from_world(stone.position)),
                         .scale = static_cast<float>(stone.scale / radius_),
                         .rotation = {q.x, q.y, q.z, q.w},
                         .albedo = stone_albedo(i),
                         .texture_scale = static_cast<float>(1 / grain),
                         .texture_offset = {random(i, 4), random(i, 5), random(i, 6)},
                         .id = id + 1});
  }
  stone_commands_ = static_cast<GLsizei>(commands.size());

  for (const RenderMesh& part : scene.meshes) {
    const MeshRange range = geometry.add(*part.mesh);
    const auto id = static_cast<std::uint32_t>(instances.size());
    commands.push_back({range.count, 1, range.first_index, range.base_vertex, id});
    instances.push_back({.position = Vec3f(view_from_world(part.origin)),
                         .scale = static_cast<float>(1 / radius_),
                         .rotation = {0, 0, 0, 1},
                         .albedo = part.color,
                         .texture_scale = 0,
                         .texture_offset = {0, 0, 0},
                         .id = id + 1});
  }
  mesh_commands_ = static_cast<GLsizei>(commands.size()) - stone_commands_;

  vertices_ = gl::make_buffer(std::span<const GpuVertex>(geometry.vertices));
  indices_ = gl::make_buffer(std::span<const std::uint32_t>(geometry.indices));
  instances_ = gl::make_buffer(std::span<const GpuInstance>(instances));
  commands_ = gl::make_buffer(std::span<const DrawCommand>(commands));

  vertex_array_ = gl::make_vertex_array();
  const GLuint array = vertex_array_.id();
  glVertexArrayElementBuffer(array, indices_.id());
  glVertexArrayVertexBuffer(array, 0, vertices_.id(), 0, sizeof(GpuVertex));
  glVertexArrayVertexBuffer(array, 1, instances_.id(), 0, sizeof(GpuInstance));
  glVertexArrayBindingDivisor(array, 1, 1);
  for (GLuint attribute = 0; attribute < 5; ++attribute) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, attribute < 2 ? 0 : 1);
  }
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, position));
  glVertexArrayAttribFormat(array, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE,
                            offsetof(GpuVertex, normal));
  glVertexArrayAttribFormat(array, 2, 4, GL_FLOAT, GL_FALSE, offsetof(GpuInstance, position));
  glVertexArrayAttribFormat(array, 3, 4, GL_FLOAT, GL_FALSE, offsetof(GpuInstance, rotation));
  glVertexArrayAttribIFormat(array, 4, 1, GL_UNSIGNED_INT, offsetof(GpuInstance, id));
}

void SceneBuffers::draw() const {
  glBindVertexArray(vertex_array_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  const auto draw_commands = [](GLsizei first, GLsizei count) {
    if (count > 0)
      glMultiDrawElementsIndirect(
          GL_TRIANGLES, GL_UNSIGNED_INT,
          reinterpret_cast<const void*>(static_cast<std::size_t>(first) * sizeof(DrawCommand)),
          count, 0);
  };
  glEnable(GL_CULL_FACE);
  draw_commands(0, stone_commands_);
  glDisable(GL_CULL_FACE);
  draw_commands(stone_commands_, mesh_commands_);
}

}  // namespace talus
