#include "talus/io/gltf_nodes.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace talus {
namespace {

using nlohmann::json;

glm::dmat4 transform(const Vec3& translation, const glm::dquat& rotation, const Vec3& scale) {
  return glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation) *
         glm::scale(glm::dmat4(1), scale);
}

glm::dmat4 parent_from_node(const GltfDocument& document, const json& node) {
  if (const std::vector<double> matrix = document.numbers(node, "matrix", 16); !matrix.empty())
    return glm::make_mat4(matrix.data());
  const std::vector<double> t = document.numbers(node, "translation", 3);
  const std::vector<double> r = document.numbers(node, "rotation", 4);
  const std::vector<double> s = document.numbers(node, "scale", 3);
  return transform(t.empty() ? Vec3(0) : Vec3(t[0], t[1], t[2]),
                   r.empty() ? glm::dquat(1, 0, 0, 0) : glm::dquat(r[3], r[0], r[1], r[2]),
                   s.empty() ? Vec3(1) : Vec3(s[0], s[1], s[2]));
}

// The chosen scene's nodes; a document without scenes shows every node that is no child.
std::vector<std::size_t> root_nodes(const GltfDocument& document) {
  if (document.size("scenes") > 0) {
    const std::size_t scene = document.index(document.root(), "scene").value_or(0);
    return document.indices(document.item("scenes", scene), "nodes");
  }
  std::vector<bool> is_child(document.size("nodes"), false);
  for (std::size_t i = 0; i < is_child.size(); ++i)
    for (const std::size_t child : document.indices(document.item("nodes", i), "children"))
      if (child < is_child.size()) is_child[child] = true;
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) roots.push_back(i);
  return roots;
}

}  // namespace

std::vector<GltfNode> placed_nodes(const GltfDocument& document) {
  std::vector<GltfNode> out, pending;
  const auto push = [&](const std::vector<std::size_t>& nodes, const glm::dmat4& place) {
    for (auto i = nodes.rbegin(); i != nodes.rend(); ++i) pending.push_back({*i, place});
  };
  std::vector<bool> visited(document.size("nodes"), false);
  push(root_nodes(document), glm::dmat4(1));
  while (!pending.empty()) {
    GltfNode next = pending.back();
    pending.pop_back();
    const json& node = document.item("nodes", next.index);
    if (visited[next.index])
      throw document.error(
          fmt::format("node {} has two parents or is its own ancestor", next.index));
    visited[next.index] = true;
    next.world_from_node *= parent_from_node(document, node);
    push(document.indices(node, "children"), next.world_from_node);
    out.push_back(next);
  }
  return out;
}

const json* instancing_attributes(const GltfDocument& document, const json& node) {
  const json* extensions = document.member(node, "extensions");
  const json* extension = extensions ? document.member(*extensions, kInstancingExtension) : nullptr;
  if (!extension) return nullptr;
  const json* attributes = document.member(*extension, "attributes");
  if (!attributes || !attributes->is_object())
    throw document.error(fmt::format("{} without attributes", kInstancingExtension));
  return attributes;
}

std::vector<glm::dmat4> node_places(const GltfDocument& document, const GltfNode& node) {
  const json* attributes = instancing_attributes(document, document.item("nodes", node.index));
  if (!attributes) return {node.world_from_node};

  const auto view = [&](const char* name, int components) -> std::optional<AccessorView> {
    const std::optional<std::size_t> index = document.index(*attributes, name);
    if (!index) return std::nullopt;
    const AccessorView found = document.accessor(*index);
    if (found.components != components)
      throw document.error(fmt::format("{} {} should have {} numbers for each instance",
                                       kInstancingExtension, name, components));
    return found;
  };
  const std::optional<AccessorView> t = view("TRANSLATION", 3), r = view("ROTATION", 4),
                                    s = view("SCALE", 3);
  const std::size_t count = t ? t->count : r ? r->count : s ? s->count : 0;
  if ((r && r->count != count) || (s && s->count != count))
    throw document.error(
        fmt::format("{} of node {}: attributes differ in count", kInstancingExtension, node.index));
  std::vector<glm::dmat4> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(node.world_from_node *
                     transform(t ? t->vec3(i) : Vec3(0),
                               r ? glm::dquat(r->at(i, 3), r->at(i, 0), r->at(i, 1), r->at(i, 2))
                                 : glm::dquat(1, 0, 0, 0),
                               s ? s->vec3(i) : Vec3(1)));
  return places;
}

}  // namespace talus
