#include "talus/render/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/render/coarse_mesh.h"

namespace talus {

namespace {

// Size of a stone, or of a pebble on bare ground, where no stone tells: share of the scene.
constexpr double kStoneRadiusWithoutStones = 0.04;
// Of a landscape, in lengths of its triangles' edges.
constexpr double kDetailEdges = 1.5;
// Cells across the longest side of a landscape's large forms.
constexpr int kLargeFormCells = 96;

double random(std::size_t stone, int what) {
  return uniform(hash(0, Purpose::texture, stone, what));
}

// A stone's own color, lighter or darker than its neighbors: close to the given one, else a mixture
// of two kinds of rock.
Vec3f stone_albedo(std::size_t stone, const std::optional<Vec3f>& color) {
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
  const Vec3f mixture = glm::mix(pick(0), pick(1), share);
  if (!color) return value * mixture;
  // As bright as asked on average; a little of the mixture's hue.
  const float brightness = (mixture.x + mixture.y + mixture.z) / (color->x + color->y + color->z);
  return value * glm::mix(*color, mixture / std::max(brightness, 1e-3f), 0.35f);
}

double median_radius(std::span<const Ball> balls) {
  std::vector<double> radii;
  for (const Ball& ball : balls) radii.push_back(ball.radius);
  const auto median = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), median, radii.end());
  return *median;
}

// Mean length of the edges of some of the triangles with shares.
double edge_length(const RenderScene& scene) {
  double sum = 0;
  double count = 0;
  for (const RenderMesh& part : scene.meshes) {
    if (part.mesh->shares.empty()) continue;
    for (std::size_t t = 0; t < part.mesh->triangles.size(); t += 61) {
      const Triangle& triangle = part.mesh->triangles[t];
      sum += glm::distance(part.mesh->positions[triangle.x], part.mesh->positions[triangle.y]);
      ++count;
    }
  }
  return sum / std::max(count, 1.0);
}

}  // namespace

SceneBuffers::SceneBuffers(const RenderScene& scene)
    : stone_count_(scene.stones ? scene.stones->instances.size() : 0),
      balls_(bounding_balls(scene)) {
  const Box3 box = bounds(balls_);
  center_ = box.center();
  // A lone point has no size; a millionth of a metre keeps the division sound.
  radius_ = std::max(0.5 * glm::length(box.size()), 1e-6);
  for (Ball& ball : balls_)
    ball = {.center = view_from_world(ball.center), .radius = ball.radius / radius_};
  if (scene.ground) ground_ = (*scene.ground - center_.z) / radius_;

  const auto shows = [](const auto& part) { return !part.mesh->triangles.empty(); };
  for (const RenderMesh& part : scene.meshes)
    if (shows(part))
      for (const MaterialShares& shares : part.mesh->shares)
        for (std::size_t i = 0; i < shares.size(); ++i) shown_surfaces_[i] |= shares[i] > 0;
  landscape_ = std::any_of(scene.water.begin(), scene.water.end(), shows) ||
               std::any_of(shown_surfaces_.begin(), shown_surfaces_.end(), std::identity());

  if (stone_count_ > 0)
    detail_radius_ = std::clamp(median_radius(std::span(balls_).first(stone_count_)), 1e-6, 0.6);
  else
    detail_radius_ =
        landscape_ ? kDetailEdges * edge_length(scene) / radius_ : kStoneRadiusWithoutStones;

  // Numbers of instances: stones, then meshes, then water.
  std::vector<GpuInstance> instances = stone_instances(scene);
  const auto place = [&](const TriangleMesh& mesh, const Vec3& origin, const Vec3f& color) {
    const auto number = static_cast<std::uint32_t>(instances.size());
    const PlacedMesh placed = {.mesh = &mesh,
                               .position = view_from_world(origin),
                               .scale = 1 / radius_,
                               .instance = number};
    instances.push_back({.position = Vec3f(placed.position),
                         .scale = static_cast<float>(placed.scale),
                         .rotation = {0, 0, 0, 1},
                         .albedo = color,
                         .texture_scale = mesh.shares.empty() ? 0.0f : -1.0f,
                         .texture_offset = {0, 0, 0},
                         .id = number + 1});
    return placed;
  };
  std::vector<PlacedMesh> meshes, water;
  for (const RenderMesh& part : scene.meshes)
    if (shows(part)) meshes.push_back(place(*part.mesh, part.origin, part.color));
  for (const RenderWater& part : scene.water)
    if (shows(part)) water.push_back(place(*part.mesh, part.origin, Vec3f(0)));

  instances_ = gl::make_buffer(std::span<const GpuInstance>(instances));
  if (stone_count_ > 0) stones_.emplace(*scene.stones, balls_);
  if (!meshes.empty()) meshes_.emplace(meshes);
  if (landscape_) make_large_forms(meshes);
  if (!water.empty()) water_.emplace(water);
}

void SceneBuffers::make_large_forms(std::vector<PlacedMesh> meshes) {
  double longest = 0;
  for (const PlacedMesh& placed : meshes)
    longest = std::max(longest, bounds(*placed.mesh).longest_side());
  large_form_cell_ = longest / kLargeFormCells / radius_;
  std::vector<TriangleMesh> coarse;
  coarse.reserve(meshes.size());
  for (PlacedMesh& placed : meshes) {
    const double share = bounds(*placed.mesh).longest_side() / std::max(longest, 1e-30);
    coarse.push_back(coarse_mesh(
        *placed.mesh, std::max(1, static_cast<int>(std::ceil(kLargeFormCells * share)))));
    placed.mesh = &coarse.back();
  }
  large_forms_.emplace(meshes);
}

std::vector<GpuInstance> SceneBuffers::stone_instances(const RenderScene& scene) const {
  std::vector<GpuInstance> instances;
  for (std::size_t i = 0; i < stone_count_; ++i) {
    const Instance& stone = scene.stones->instances[i];
    // The grain of a stone's texture follows its size halfway: a boulder shows more of it than a
    // cobble, yet neither is smooth or noise.
    const double grain = std::sqrt(std::max(balls_[i].radius, 1e-9) * detail_radius_);
    const Quat& q = stone.rotation;
    instances.push_back({.position = Vec3f(view_from_world(stone.position)),
                         .scale = static_cast<float>(stone.scale / radius_),
                         .rotation = {q.x, q.y, q.z, q.w},
                         .albedo = stone_albedo(i, scene.stone_color),
                         .texture_scale = static_cast<float>(1 / grain),
                         .texture_offset = {random(i, 4), random(i, 5), random(i, 6)},
                         .id = static_cast<std::uint32_t>(i) + 1});
  }
  return instances;
}

void SceneBuffers::draw_stones(const Sight& sight) const {
  if (!stones_) return;
  glEnable(GL_CULL_FACE);
  stones_->draw(sight);
}

void SceneBuffers::draw_meshes(const Sight& sight) const {
  if (!meshes_) return;
  glDisable(GL_CULL_FACE);
  meshes_->draw(sight);
}

void SceneBuffers::draw_large_forms(const Sight& sight) const {
  if (!large_forms_) return;
  glDisable(GL_CULL_FACE);
  large_forms_->draw(sight);
}

void SceneBuffers::draw_water(const Sight& sight) const {
  if (!water_) return;
  glDisable(GL_CULL_FACE);
  water_->draw(sight);
}

}  // namespace talus
