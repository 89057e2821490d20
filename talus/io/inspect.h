// What is in a file, and whether it is sound.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "talus/base/vec.h"
#include "talus/mesh/check.h"
#include "talus/rocks/tile_set.h"

namespace talus {

// Soundness of EXT_mesh_gpu_instancing, which the Khronos validator does not look at.
struct InstancingCheck {
  std::uint64_t instances = 0;
  std::uint64_t prototypes = 0;       // meshes that are instanced
  std::vector<std::string> problems;  // one line each; empty when sound
};

// Looks at every node that carries instances: attributes of equal count and of the types the
// extension allows, finite values, unit quaternions (to 1e-3), the
// extension listed as used and required. Throws `Error` (input) for a file that is no glTF.
InstancingCheck check_instancing(const std::filesystem::path& path);

// A named part of a scene: `stones`, `ground`, ...
struct ScenePart {
  std::string name;             // "stones 2" for the second of a name
  std::uint64_t instances = 0;  // meshes drawn: instances, nodes and objects counted
  std::uint64_t unique = 0;     // distinct meshes
  std::uint64_t triangles = 0;  // drawn
  MeshCheck check;              // of the distinct meshes, each by itself, counts added up
};

// A triangle mesh in world coordinates, all parts together.
struct MeshInfo {
  MeshCheck check;
  Box3 bounds;
  std::optional<double> volume;  // signed, m^3; of a mesh that bounds solids
};

// What was found; absent is what the kind of file has not.
struct Inspection {
  std::uint64_t bytes = 0;
  std::optional<MeshInfo> mesh;               // any mesh, but a scene that draws one repeatedly
  std::vector<ScenePart> parts;               // glTF: nodes at the top; OBJ of several objects
  std::optional<InstancingCheck> instancing;  // glTF that uses the extension
  std::shared_ptr<const TileSet> tiles;       // tile sets
  std::vector<std::string> warnings;          // one line each
};

// Reads the file and reports. A glTF that draws a mesh more than once is not expanded: each mesh is
// judged once. The objects of an OBJ are judged one by one; those named "stones/..." are the part
// `stones`. Throws `Error` (input) for a file that cannot be read as a mesh, a scene or a tile
// set.
Inspection inspect(const std::filesystem::path& path);

}  // namespace talus
