// Triangle meshes from other people's files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "talus/base/describe.h"
#include "talus/mesh/triangle_mesh.h"

namespace talus {

enum class Axis { x, y, z };

struct ReadMeshParams {
  std::optional<Axis> up;
  double scale = 1;

  static void describe(auto& p, auto&& field) {
    field(p.up, Field{.name = "up",
                      .help = "axis of the file that points up; by default z for PLY, STL and OFF, "
                              "y for every other format"});
    field(p.scale,
          Field{.name = "scale", .help = "metres per unit of the file", .min = 1e-9, .max = 1e9});
  }
};

// A named part of a mesh: its triangles from `first_triangle` to that of the next part.
struct MeshObject {
  std::string name;
  std::size_t first_triangle = 0;
};

struct ReadMeshResult {
  TriangleMesh mesh;                  // z up, metres; no normals
  std::vector<MeshObject> objects;    // of an OBJ file, in order
  std::vector<std::string> warnings;  // one line each, naming the file
};

// The triangles of a glTF, GLB, OBJ, PLY, STL or OFF file, or of any other format assimp knows by
// its extension. The whole scene becomes one mesh: nodes and instances are placed, polygons cut
// into triangles, lines and points dropped, vertices at bit-equal positions joined.
//
// File axes become z up by a rotation: y up (x, y, z) -> (x, -z, y), x up (x, y, z) -> (y, z, x).
//
// Throws `Error` (input) naming the file, the place in it and what would be right: the file is
// missing, unreadable, empty, no mesh, cut off, or has no triangles, a coordinate that is not
// finite, an index out of range, counts its size cannot hold. Counts are checked before memory is
// taken. Throws `Error` (usage) for parameters out of range. Whatever the bytes of one of the six
// formats are, it does nothing else; for the rest assimp is trusted.
ReadMeshResult read_mesh(const std::filesystem::path& path, const ReadMeshParams& params = {});

}  // namespace talus
