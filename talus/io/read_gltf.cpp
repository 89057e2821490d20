#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "talus/io/gltf_document.h"
#include "talus/io/gltf_nodes.h"
#include "talus/io/mesh_formats.h"

namespace talus {
namespace {

using nlohmann::json;

// Instances multiply what a small file holds; more than this is refused.
constexpr std::size_t kTrianglesMax = 100'000'000;

std::vector<Vec3> primitive_positions(const GltfDocument& document, const json& primitive) {
  const json* attributes = document.member(primitive, "attributes");
  if (!attributes || !attributes->is_object())
    throw document.error("a primitive has no attributes");
  const std::optional<std::size_t> index = document.index(*attributes, "POSITION");
  if (!index) return {};
  const AccessorView view = document.accessor(*index);
  if (view.components != 3) throw document.error("POSITION should be of type VEC3");
  std::vector<Vec3> positions(view.count);
  for (std::size_t i = 0; i < view.count; ++i) positions[i] = view.vec3(i);
  return positions;
}

// The corner list that the triangles of a primitive are made of.
std::vector<std::uint32_t> primitive_corners(const GltfDocument& document, const json& primitive,
                                             std::size_t vertex_count) {
  std::vector<std::uint32_t> corners;
  if (const std::optional<std::size_t> index = document.index(primitive, "indices")) {
    const AccessorView view = document.accessor(*index);
    if (view.components != 1 || !view.is_unsigned() || view.normalized)
      throw document.error("indices should be unsigned whole numbers");
    corners.resize(view.count);
    for (std::size_t i = 0; i < view.count; ++i) {
      corners[i] = static_cast<std::uint32_t>(view.at(i, 0));
      if (corners[i] >= vertex_count)
        throw document.error(fmt::format("a triangle uses vertex {}, but its primitive has {}",
                                         corners[i], vertex_count));
    }
  } else {
    corners.resize(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  return corners;
}

constexpr std::size_t kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& corners, std::size_t mode) {
  std::vector<Triangle> out;
  if (mode == kTriangles) {
    for (std::size_t i = 2; i < corners.size(); i += 3)
      out.emplace_back(corners[i - 2], corners[i - 1], corners[i]);
    return out;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    // Every other triangle of a strip is turned; those of two corners only stitch strips together.
    Triangle t(corners[i - 2], corners[i - 1], corners[i]);
    if (mode == kTriangleFan) t = {corners[0], corners[i - 1], corners[i]};
    if (mode == kTriangleStrip && i % 2 == 1) std::swap(t.x, t.y);
    if (t.x != t.y && t.y != t.z && t.z != t.x) out.push_back(t);
  }
  return out;
}

void append_mesh(const GltfDocument& document, std::size_t mesh_index,
                 const std::vector<glm::dmat4>& places, FileMesh& mesh) {
  const json* primitives = document.member(document.item("meshes", mesh_index), "primitives");
  if (!primitives || !primitives->is_array())
    throw document.error(fmt::format("mesh {} has no primitives", mesh_index));
  for (const json& primitive : *primitives) {
    const std::size_t mode = document.index(primitive, "mode").value_or(kTriangles);
    if (mode != kTriangles && mode != kTriangleStrip && mode != kTriangleFan) {
      ++mesh.dropped;
      continue;
    }
    const std::vector<Vec3> positions = primitive_positions(document, primitive);
    const std::vector<Triangle> triangles =
        triangles_of(primitive_corners(document, primitive, positions.size()), mode);
    const std::size_t larger = std::max(positions.size(), triangles.size());
    const std::size_t room =
        kTrianglesMax -
        std::min(kTrianglesMax, std::max(mesh.positions.size(), mesh.triangles.size()));
    if (larger > 0 && places.size() > room / larger)
      throw document.error(
          fmt::format("more than {} triangles once its instances are placed", kTrianglesMax));

    for (const glm::dmat4& place : places) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Vec3& p : positions) mesh.positions.emplace_back(place * glm::dvec4(p, 1));
      // A mirrored mesh keeps its outside out.
      const bool mirrored = glm::determinant(glm::dmat3(place)) < 0;
      for (const Triangle& t : triangles)
        mesh.triangles.push_back((mirrored ? Triangle(t.x, t.z, t.y) : t) + first);
    }
  }
}

}  // namespace

FileMesh read_gltf_mesh(const GltfDocument& document, std::size_t index) {
  FileMesh mesh;
  append_mesh(document, index, {glm::dmat4(1)}, mesh);
  return mesh;
}

FileMesh read_gltf(std::string_view bytes, const std::filesystem::path& path) {
  const GltfDocument document(bytes, path);
  document.check_extensions();
  FileMesh mesh;
  for (const GltfNode& node : placed_nodes(document))
    if (const std::optional<std::size_t> index =
            document.index(document.item("nodes", node.index), "mesh"))
      append_mesh(document, *index, node_places(document, node), mesh);
  return mesh;
}

}  // namespace talus
