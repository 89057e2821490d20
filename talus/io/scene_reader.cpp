#include "talus/io/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <string>
#include <utility>

#include "talus/base/parallel.h"
#include "talus/io/gltf_document.h"
#include "talus/io/gltf_nodes.h"
#include "talus/io/mesh_formats.h"
#include "talus/io/read_file.h"

namespace talus {
namespace {

using nlohmann::json;

// glTF to world.
Vec3 z_up(const Vec3& p) { return {p.x, -p.z, p.y}; }

// What the writer tells of the scene; null if another program wrote the file.
const json* extras_of(const GltfDocument& document) {
  const json* asset = document.member(document.root(), "asset");
  const json* generator = asset ? document.member(*asset, "generator") : nullptr;
  if (!generator || *generator != "Talus" || document.size("scenes") == 0) return nullptr;
  const json* extras = document.member(document.item("scenes", 0), "extras");
  return extras && extras->is_object() ? extras : nullptr;
}

void check_finite(const GltfDocument& document, const Vec3& v) {
  if (!std::isfinite(v.x + v.y + v.z))
    throw document.error("a number is not finite; positions and directions must be");
}

std::string name_of(const json& node) {
  const auto name = node.find("name");
  return name != node.end() && name->is_string() ? name->get<std::string>() : "";
}

// An attribute with a row for each of so many vertices; nothing if there is none such.
std::optional<AccessorView> rows(const GltfDocument& document, const json& attributes,
                                 const char* name, std::size_t count, int components) {
  const std::optional<std::size_t> index = document.index(attributes, name);
  if (!index) return std::nullopt;
  const AccessorView view = document.accessor(*index);
  if (view.count != count || view.components != components)
    throw document.error(std::string(name) + " does not fit the vertices");
  return view;
}

TriangleMesh mesh_at(const GltfDocument& document, std::size_t index) {
  const FileMesh read = read_gltf_mesh(document, index);
  TriangleMesh mesh{.triangles = read.triangles};
  for (const Vec3& p : read.positions) {
    check_finite(document, p);
    mesh.positions.emplace_back(z_up(p));
  }

  // What is written has one primitive a mesh.
  const json& primitives = *document.member(document.item("meshes", index), "primitives");
  if (primitives.size() != 1 || mesh.triangles.empty()) return mesh;
  const json& attributes = *document.member(primitives[0], "attributes");
  const std::size_t count = mesh.positions.size();
  if (const auto normals = rows(document, attributes, "NORMAL", count, 3))
    for (std::size_t i = 0; i < count; ++i) {
      check_finite(document, normals->vec3(i));
      mesh.normals.emplace_back(z_up(normals->vec3(i)));
    }
  const auto low = rows(document, attributes, "_MATERIALS_0", count, 4);
  const auto high = rows(document, attributes, "_MATERIALS_1", count, 4);
  if (!low || !high) return mesh;
  mesh.shares.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < 4; ++c) {
      const auto byte = [&](const AccessorView& view) {
        return static_cast<std::uint8_t>(std::clamp(std::round(255 * view.at(i, c)), 0.0, 255.0));
      };
      mesh.shares[i][static_cast<std::size_t>(c)] = byte(*low);
      mesh.shares[i][static_cast<std::size_t>(c) + 4] = byte(*high);
    }
  return mesh;
}

// A place of the file as one in the world: turned, scaled alike along all axes, moved. `step` is
// the length of one unit of its mesh.
Instance instance_at(const GltfDocument& document, const glm::dmat4& place, double step) {
  const glm::dmat3 to_world(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
  const glm::dmat3 linear = to_world * glm::dmat3(place) * glm::transpose(to_world);
  const double scale = std::cbrt(glm::determinant(linear));
  check_finite(document, Vec3(place[3]));
  if (!(scale > 0) || !std::isfinite(scale))
    throw document.error("a stone is mirrored or has no size; it must be turned and scaled only");
  return {.position = z_up(Vec3(place[3])),
          .rotation = Quat(glm::normalize(glm::quat_cast(linear / scale))),
          .scale = static_cast<float>(scale / step)};
}

// Stones as their nodes are met: first the places, then, all at once, the meshes.
class StonesReader {
 public:
  // `step` is the length of one unit of the meshes.
  StonesReader(const GltfDocument& document, double step) : document_(document), step_(step) {}

  void add(const GltfNode& node, std::size_t mesh) {
    const std::vector<glm::dmat4> places = node_places(document_, node);
    if (places.empty()) return;
    const auto next = static_cast<std::uint32_t>(meshes_.size());
    const auto [entry, is_new] = prototype_of_mesh_.emplace(mesh, next);
    if (is_new) meshes_.push_back(mesh);
    for (const glm::dmat4& place : places) {
      Instance& instance = stones_.instances.emplace_back(instance_at(document_, place, step_));
      instance.prototype = entry->second;
    }
  }

  InstanceTable read() {
    stones_.prototypes.resize(meshes_.size());
    parallel_for(meshes_.size(), [&](std::size_t k) {
      TriangleMesh mesh = mesh_at(document_, meshes_[k]);
      for (Vec3f& p : mesh.positions) p *= static_cast<float>(step_);
      stones_.prototypes[k] = std::make_shared<const TriangleMesh>(std::move(mesh));
    });
    std::stable_sort(
        stones_.instances.begin(), stones_.instances.end(),
        [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; });
    return std::move(stones_);
  }

 private:
  const GltfDocument& document_;
  double step_;
  std::map<std::size_t, std::uint32_t> prototype_of_mesh_;
  std::vector<std::size_t> meshes_;
  InstanceTable stones_;
};

std::optional<double> number(const GltfDocument& document, const json& extras, const char* key) {
  const json* found = document.member(extras, key);
  if (!found) return std::nullopt;
  if (!found->is_number()) throw document.error(std::string(key) + " should be a number");
  return found->get<double>();
}

double position_step(const GltfDocument& document, const json& extras) {
  const double step = number(document, extras, "position_step").value_or(1);
  if (!(step > 0)) throw document.error("position_step should be above 0");
  return step;
}

}  // namespace

std::optional<SceneFile> read_scene(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const GltfDocument document(bytes, path);
  const json* extras = extras_of(document);
  const json* instances = extras ? document.member(*extras, "instances") : nullptr;
  if (!instances || *instances == "flattened") return std::nullopt;
  document.check_extensions();
  SceneFile scene;
  scene.plane = number(document, *extras, "plane");
  StonesReader stones(document, position_step(document, *extras));
  for (const GltfNode& node : placed_nodes(document)) {
    const json& entry = document.item("nodes", node.index);
    const std::optional<std::size_t> mesh = document.index(entry, "mesh");
    if (!mesh) continue;
    const std::string name = name_of(entry);
    if (name == "ground" || name == "water") {
      const Vec3 origin(node.world_from_node[3]);
      check_finite(document, origin);
      (name == "ground" ? scene.ground : scene.water) = mesh_at(document, *mesh);
      (name == "ground" ? scene.ground_origin : scene.water_origin) = z_up(origin);
    } else {
      stones.add(node, *mesh);
    }
  }
  scene.stones = stones.read();
  if (scene.ground.triangles.empty() && scene.water.triangles.empty() &&
      scene.stones.instances.empty())
    throw document.error("no triangles");
  return scene;
}

}  // namespace talus
