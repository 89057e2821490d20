// Where the nodes of a glTF scene stand.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

#include "talus/io/gltf_document.h"

namespace talus {

struct GltfNode {
  std::size_t index;
  glm::dmat4 world_from_node;
};

// The nodes of the document's scene, parents first. Throws `Error` (input) for a node that has two
// parents or is its own ancestor, and for a malformed transform.
std::vector<GltfNode> placed_nodes(const GltfDocument& document);

// Where the node's mesh is drawn: once, or once for each instance of EXT_mesh_gpu_instancing.
std::vector<glm::dmat4> node_places(const GltfDocument& document, const GltfNode& node);

// The attributes of EXT_mesh_gpu_instancing on a node; null if it has none.
const nlohmann::json* instancing_attributes(const GltfDocument& document,
                                            const nlohmann::json& node);

}  // namespace talus
