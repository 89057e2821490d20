#include "talus/io/glb_surface.h"

#include <utility>

#include "talus/io/material_color.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr float kWaterOpacity = 0.6f;

json material_names() {
  json names = json::array();
  for (const MaterialInfo& info : material_infos()) names.push_back(std::string(info.name));
  return names;
}

json ground_material() {
  return {{"name", "ground"},
          {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.95}}}};
}

json water_material() {
  const Vec3f color = material_info(Material::water).color;
  return {{"name", "water"},
          {"alphaMode", "BLEND"},
          {"doubleSided", true},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {color.x, color.y, color.z, kWaterOpacity}},
            {"metallicFactor", 0},
            {"roughnessFactor", 0.05}}}};
}

// Color and shares of each vertex of the ground.
void add_shares(const TriangleMesh& mesh, GlbFile& file, json& attributes) {
  const std::size_t count = mesh.positions.size();
  const auto add = [&](const char* name, GlbFile::Write write) {
    const std::size_t view = file.add_view(4 * count, kArrayBuffer, 4, std::move(write));
    attributes[name] = file.add_accessor(view, 0, kUnsignedByte, "VEC4", count, true);
  };
  add("COLOR_0", [&mesh](AtomicFile& out) {
    for (const MaterialShares& shares : mesh.shares) {
      const auto [red, green, blue] = linear_bytes(blended_color(shares));
      out.write_value(std::array<std::uint8_t, 4>{red, green, blue, 255});
    }
  });
  for (const auto& [name, first] : {std::pair{"_MATERIALS_0", 0u}, {"_MATERIALS_1", 4u}})
    add(name, [&mesh, first = first](AtomicFile& out) {
      for (const MaterialShares& shares : mesh.shares) out.write(shares.data() + first, 4);
    });
}

}  // namespace

void GlbSurfaces::add_to(GlbFile& file, GlbStats& stats) {
  add_surface("ground", scene_.ground, ground_material(), file, stats);
  add_surface("water", scene_.water, water_material(), file, stats);
}

void GlbSurfaces::add_surface(const char* name, const PlacedMesh& placed, const json& material,
                              GlbFile& file, GlbStats& stats) {
  if (!placed.mesh || placed.mesh->triangles.empty()) return;
  const TriangleMesh& mesh = *placed.mesh;
  const std::vector<Vec3f>* normals = &mesh.normals;
  if (normals->empty()) {
    computed_.push_back({.positions = mesh.positions, .triangles = mesh.triangles});
    compute_normals(computed_.back());
    normals = &computed_.back().normals;
  }

  const std::size_t count = mesh.positions.size();
  const auto add_vectors = [&](const std::vector<Vec3f>& vectors) {
    const std::size_t view =
        file.add_view(12 * count, kArrayBuffer, 12, [&vectors](AtomicFile& out) {
          for (const Vec3f& v : vectors) out.write_value(y_up(v));
        });
    return file.add_accessor(view, 0, kFloat, "VEC3", count);
  };
  const std::size_t positions = add_vectors(mesh.positions);
  Vec3f min = y_up(mesh.positions[0]), max = min;
  for (const Vec3f& p : mesh.positions) {
    min = glm::min(min, y_up(p));
    max = glm::max(max, y_up(p));
  }
  file.at("accessors", positions)["min"] = {min.x, min.y, min.z};
  file.at("accessors", positions)["max"] = {max.x, max.y, max.z};
  json attributes = {{"POSITION", positions}, {"NORMAL", add_vectors(*normals)}};
  if (!mesh.shares.empty()) add_shares(mesh, file, attributes);

  const std::size_t index_view = file.add_view(
      12 * mesh.triangles.size(), kElementArrayBuffer, 0,
      [&mesh](AtomicFile& out) { out.write(mesh.triangles.data(), 12 * mesh.triangles.size()); });
  const std::size_t indices =
      file.add_accessor(index_view, 0, kUnsignedInt, "SCALAR", 3 * mesh.triangles.size());
  const json primitive = {{"attributes", attributes},
                          {"indices", indices},
                          {"material", file.add("materials", material)}};
  json entry = {{"name", name}, {"primitives", json::array({primitive})}};
  if (!mesh.shares.empty()) entry["extras"] = {{"materials", material_names()}};
  const std::size_t index = file.add("meshes", std::move(entry));
  const Vec3 origin = y_up(placed.origin);
  file.add_part({{"name", name}, {"mesh", index}, {"translation", {origin.x, origin.y, origin.z}}});
  stats.vertices += count;
  stats.triangles += mesh.triangles.size();
}

}  // namespace talus
