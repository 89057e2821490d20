#include "talus/io/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <string>

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

// A place of the file as one in the world: turned, scaled alike along all axes, moved.
Instance instance_at(const GltfDocument& document, const glm::dmat4& place) {
  const glm::dmat3 to_world(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
  const glm::dmat3 linear = to_world * glm::dmat3(place) * glm::transpose(to_world);
  const double scale = std::cbrt(glm::determinant(linear));
  check_finite(document, Vec3(place[3]));
  if (!(scale > 0) || !std::isfinite(scale))
    throw document.error("a stone is mirrored or has no size; it must be turned and scaled only");
  return {.position = z_up(Vec3(place[3])),
          .rotation = Quat(glm::normalize(glm::quat_cast(linear / scale))),
          .scale = static_cast<float>(scale)};
}

// Adds the stones of a node.
void add_stones(const GltfDocument& document, const GltfNode& node, std::size_t mesh,
                std::map<std::size_t, std::uint32_t>& prototype_of_mesh, InstanceTable& stones) {
  const std::vector<glm::dmat4> places = node_places(document, node);
  if (places.empty()) return;
  const auto [entry, is_new] =
      prototype_of_mesh.emplace(mesh, static_cast<std::uint32_t>(stones.prototypes.size()));
  if (is_new)
    stones.prototypes.push_back(std::make_shared<const TriangleMesh>(mesh_at(document, mesh)));
  for (const glm::dmat4& place : places) {
    stones.instances.push_back(instance_at(document, place));
    stones.instances.back().prototype = entry->second;
  }
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
  if (const json* plane = document.member(*extras, "plane")) {
    if (!plane->is_number()) throw document.error("plane should be a number");
    scene.plane = plane->get<double>();
  }
  std::map<std::size_t, std::uint32_t> prototype_of_mesh;
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
      add_stones(document, node, *mesh, prototype_of_mesh, scene.stones);
    }
  }
  if (scene.ground.triangles.empty() && scene.water.triangles.empty() &&
      scene.stones.instances.empty())
    throw document.error("no triangles");
  std::stable_sort(scene.stones.instances.begin(), scene.stones.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; });
  return scene;
}

}  // namespace talus
