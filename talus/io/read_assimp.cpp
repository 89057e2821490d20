#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "talus/base/error.h"
#include "talus/io/mesh_formats.h"

namespace talus {

FileMesh read_with_assimp(std::string_view bytes, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  Assimp::Importer importer;
  if (extension.empty() || !importer.IsExtensionSupported(extension))
    throw input_error(fmt::format(
        "{}: unknown mesh format \"{}\"; glTF, GLB, OBJ, PLY, STL and OFF are read best",
        path.string(), extension));

  // Node transforms are applied by assimp; lines and points are left to be dropped here.
  const unsigned flags =
      aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), flags, extension.c_str() + 1);
  if (!scene)
    throw input_error(
        fmt::format("{}: no readable mesh: {}", path.string(), importer.GetErrorString()));

  FileMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v)
      mesh.positions.emplace_back(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) {
        ++mesh.dropped;
        continue;
      }
      const Triangle corners(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      for (int c = 0; c < 3; ++c)
        if (corners[c] >= part.mNumVertices)
          throw input_error(fmt::format("{}: a face uses vertex {}, but there are {}",
                                        path.string(), corners[c], part.mNumVertices));
      mesh.triangles.push_back(corners + first);
    }
  }
  return mesh;
}

}  // namespace talus
