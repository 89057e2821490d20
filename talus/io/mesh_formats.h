// Readers of single mesh formats, behind `read_mesh`: bytes in, triangles out in the file's axes.
//
// Each throws `Error` (input) naming the file for anything malformed; indices that come out are in
// range. None takes memory on the word of a header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "talus/base/vec.h"
#include "talus/io/mesh_reader.h"

namespace talus {

class GltfDocument;

struct FileMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<MeshObject> objects;
  std::uint64_t dropped = 0;  // lines, points and polygons with fewer than three corners
};

FileMesh read_obj(std::string_view text, const std::string& path);
FileMesh read_ply(std::string_view bytes, const std::string& path);
FileMesh read_stl(std::string_view bytes, const std::string& path);
FileMesh read_off(std::string_view text, const std::string& path);
// `bytes` of a .gltf or .glb; buffers it names are read beside it.
FileMesh read_gltf(std::string_view bytes, const std::filesystem::path& path);
// One mesh of a document, in its own coordinates.
FileMesh read_gltf_mesh(const GltfDocument& document, std::size_t index);
// Any other format, recognized by the extension.
FileMesh read_with_assimp(std::string_view bytes, const std::filesystem::path& path);

// ".gltf" for "a.GLTF".
std::string lower_extension(const std::filesystem::path& path);

// Cuts a polygon, concave or not, into triangles and appends them; fewer than three corners count
// as dropped. The corners are indices into `mesh.positions`, in range.
void append_polygon(std::span<const std::uint32_t> corners, FileMesh& mesh);

}  // namespace talus
