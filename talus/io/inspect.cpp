#include "talus/io/inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "talus/base/parallel.h"
#include "talus/io/gltf_document.h"
#include "talus/io/gltf_nodes.h"
#include "talus/io/mesh_formats.h"
#include "talus/io/mesh_reader.h"
#include "talus/io/read_file.h"
#include "talus/io/tile_set_file.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr double kQuaternionTolerance = 1e-3;

bool lists(const GltfDocument& document, const char* list, std::string_view name) {
  const json* found = document.member(document.root(), list);
  if (!found || !found->is_array()) return false;
  for (const json& entry : *found)
    if (entry.is_string() && entry.get<std::string>() == name) return true;
  return false;
}

bool is_finite(const AccessorView& view) {
  for (std::size_t i = 0; i < view.count; ++i)
    for (int c = 0; c < view.components; ++c)
      if (!std::isfinite(view.at(i, c))) return false;
  return true;
}

bool is_unit(const AccessorView& view) {
  for (std::size_t i = 0; i < view.count; ++i) {
    double square = 0;
    for (int c = 0; c < view.components; ++c) square += view.at(i, c) * view.at(i, c);
    if (!(std::abs(std::sqrt(square) - 1) <= kQuaternionTolerance)) return false;
  }
  return true;
}

// Checks the attributes of one node and returns how many instances they agree on.
std::size_t check_attributes(const GltfDocument& document, std::size_t node, const json& attributes,
                             std::vector<std::string>& problems) {
  const auto problem = [&](std::string_view what) {
    problems.push_back(fmt::format("node {}: {}", node, what));
  };
  std::optional<std::size_t> count;
  for (const auto& [name, components] :
       {std::pair{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}}) {
    const std::optional<std::size_t> index = document.index(attributes, name);
    if (!index) continue;
    const AccessorView view = document.accessor(*index);
    const bool is_rotation = components == 4;
    const bool typed =
        view.components == components &&
        (view.is_float() || (is_rotation && view.normalized &&
                             (view.component_type == 5120 || view.component_type == 5122)));
    if (!typed) {
      problem(fmt::format("{} should be {} floats for each instance", name, components));
      continue;
    }
    if (!is_finite(view)) problem(fmt::format("{} has values that are not finite", name));
    if (is_rotation && !is_unit(view))
      problem("ROTATION has quaternions that are not of unit length");
    if (count.value_or(view.count) != view.count)
      problem(
          fmt::format("{} has {} instances, an earlier attribute {}", name, view.count, *count));
    count = count.value_or(view.count);
  }
  if (!count) problem("no TRANSLATION, ROTATION or SCALE");
  return count.value_or(0);
}

InstancingCheck check_document(const GltfDocument& document) {
  InstancingCheck check;
  bool carries_instances = false;
  std::set<std::size_t> meshes;
  for (const GltfNode& placed : placed_nodes(document)) {
    const json& node = document.item("nodes", placed.index);
    const json* attributes = instancing_attributes(document, node);
    if (!attributes) continue;
    carries_instances = true;
    check.instances += check_attributes(document, placed.index, *attributes, check.problems);
    const std::optional<std::size_t> mesh = document.index(node, "mesh");
    if (!mesh)
      check.problems.push_back(fmt::format("node {}: instances of no mesh", placed.index));
    else
      meshes.insert(*mesh);
  }
  check.prototypes = meshes.size();
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    if (carries_instances && !lists(document, list, kInstancingExtension))
      check.problems.push_back(fmt::format("{} is not in {}", kInstancingExtension, list));
  return check;
}

TriangleMesh mesh_of(const GltfDocument& document, std::size_t index) {
  const FileMesh read = read_gltf_mesh(document, index);
  TriangleMesh mesh{.triangles = read.triangles};
  for (const Vec3& p : read.positions) mesh.positions.emplace_back(p);
  return mesh;
}

MeshCheck sum(MeshCheck a, const MeshCheck& b) {
  a.vertices += b.vertices;
  a.triangles += b.triangles;
  a.degenerate += b.degenerate;
  a.boundary_edges += b.boundary_edges;
  a.non_manifold_edges += b.non_manifold_edges;
  a.misoriented_edges += b.misoriented_edges;
  a.non_manifold_vertices += b.non_manifold_vertices;
  a.unbalanced_edges += b.unbalanced_edges;
  return a;
}

// `name`, or the first of "name 2", "name 3", ... that is not in `used`, and notes it there.
std::string unused_name(const std::string& name, std::set<std::string>& used) {
  std::string candidate = name;
  for (int i = 2; !used.insert(candidate).second; ++i) candidate = fmt::format("{} {}", name, i);
  return candidate;
}

// Sums what each node at the top has below it.
std::vector<ScenePart> parts_of(const GltfDocument& document) {
  std::vector<MeshCheck> checks(document.size("meshes"));
  parallel_for(checks.size(), [&](std::size_t i) { checks[i] = check_mesh(mesh_of(document, i)); });
  std::map<std::size_t, std::size_t> part_of_node;
  std::vector<ScenePart> parts;
  std::vector<std::set<std::size_t>> meshes;
  std::set<std::string> names;
  for (const GltfNode& placed : placed_nodes(document)) {
    const json& node = document.item("nodes", placed.index);
    if (!part_of_node.contains(placed.index)) {
      part_of_node[placed.index] = parts.size();
      const json* name = document.member(node, "name");
      parts.push_back(
          {.name = unused_name(name && name->is_string() ? name->get<std::string>() : "?", names)});
      meshes.emplace_back();
    }
    const std::size_t part = part_of_node[placed.index];
    for (const std::size_t child : document.indices(node, "children")) part_of_node[child] = part;
    if (const std::optional<std::size_t> mesh = document.index(node, "mesh")) {
      const std::size_t drawn = node_places(document, placed).size();
      parts[part].instances += drawn;
      if (*mesh >= checks.size())
        throw document.error(
            fmt::format("node {} draws mesh {} of {}", placed.index, *mesh, checks.size()));
      parts[part].triangles += drawn * checks[*mesh].triangles;
      if (meshes[part].insert(*mesh).second)
        parts[part].check = sum(parts[part].check, checks[*mesh]);
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].unique = meshes[i].size();
  return parts;
}

// Some triangles of a mesh with the vertices that they use.
TriangleMesh cut_out(const TriangleMesh& mesh, std::size_t begin, std::size_t end) {
  TriangleMesh part;
  std::vector<std::uint32_t> used;
  for (std::size_t t = begin; t < end; ++t)
    for (int c = 0; c < 3; ++c) used.push_back(mesh.triangles[t][c]);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t v : used) part.positions.push_back(mesh.positions[v]);
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  };
  for (std::size_t t = begin; t < end; ++t) {
    const Triangle& corners = mesh.triangles[t];
    part.triangles.emplace_back(place(corners.x), place(corners.y), place(corners.z));
  }
  return part;
}

// Sums the objects whose names agree up to a slash.
std::vector<ScenePart> parts_of(const TriangleMesh& mesh, const std::vector<MeshObject>& objects) {
  std::vector<MeshCheck> checks(objects.size());
  parallel_for(objects.size(), [&](std::size_t i) {
    const std::size_t end =
        i + 1 < objects.size() ? objects[i + 1].first_triangle : mesh.triangles.size();
    checks[i] = check_mesh(cut_out(mesh, objects[i].first_triangle, end));
  });
  std::vector<ScenePart> parts;
  std::map<std::string, std::size_t> part_of_name;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string name = objects[i].name.substr(0, objects[i].name.find('/'));
    const auto [known, is_new] = part_of_name.try_emplace(name, parts.size());
    if (is_new) parts.push_back({.name = name});
    ScenePart& part = parts[known->second];
    ++part.instances;
    ++part.unique;
    part.triangles += checks[i].triangles;
    part.check = sum(part.check, checks[i]);
  }
  return parts;
}

MeshInfo info_of(const TriangleMesh& mesh) {
  MeshInfo info{.check = check_mesh(mesh), .bounds = bounds(mesh)};
  if (info.check.bounds_solids()) info.volume = signed_volume(mesh);
  return info;
}

}  // namespace

InstancingCheck check_instancing(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return check_document(GltfDocument(bytes, path));
}

Inspection inspect(const std::filesystem::path& path) {
  Inspection found;
  const std::string bytes = read_file(path);
  found.bytes = bytes.size();
  if (is_tile_set(bytes)) {
    found.tiles = std::make_shared<const TileSet>(load_tile_set(path));
    return found;
  }
  if (bytes.starts_with("glTF") || lower_extension(path) == ".gltf") {
    const GltfDocument document(bytes, path);
    found.parts = parts_of(document);
    if (lists(document, "extensionsUsed", kInstancingExtension))
      found.instancing = check_document(document);
    const auto repeats = [](const ScenePart& part) { return part.instances > part.unique; };
    if (found.instancing || std::any_of(found.parts.begin(), found.parts.end(), repeats))
      return found;
  }
  ReadMeshResult read = read_mesh(path);
  found.mesh = info_of(read.mesh);
  // Triangles before the first name are a part as well.
  if (!read.objects.empty() && read.objects.front().first_triangle > 0)
    read.objects.insert(read.objects.begin(), {.name = "(no name)"});
  if (read.objects.size() > 1) found.parts = parts_of(read.mesh, read.objects);
  found.warnings = std::move(read.warnings);
  return found;
}

}  // namespace talus
