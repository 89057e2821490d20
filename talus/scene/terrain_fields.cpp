#include "talus/scene/terrain_fields.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus {
namespace {

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const MaterialInfo& info : material_infos()) names.emplace_back(info.name);
  return names;
}

}  // namespace

void read_value(const Value& value, const std::string& path, Material& out) {
  std::string name;
  read_value(value, path, name);
  const std::vector<std::string> names = material_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail_at(value.where, path,
            fmt::format("unknown material \"{}\"; {}", name, suggest(name, names)));
  out = static_cast<Material>(found - names.begin());
}

Value write_value(Material material) {
  return write_value(std::string(material_info(material).name));
}

std::string type_name(Material) { return "material"; }

void read_value(const Value& value, const std::string& path, MaterialSet& out) {
  std::vector<Material> materials;
  read_value(value, path, materials);
  out = {};
  for (const Material material : materials) out.insert(material);
}

Value write_value(const MaterialSet& materials) {
  Value::Array names;
  for (int i = 0; i < kMaterialCount; ++i)
    if (materials.contains(static_cast<Material>(i)))
      names.push_back(write_value(static_cast<Material>(i)));
  return {names};
}

std::string type_name(const MaterialSet&) { return "list of materials"; }

void read_value(const Value& value, const std::string& path, SurfacePoint& out) {
  std::vector<double> numbers;
  read_value(value, path, numbers);
  if (numbers.size() != 2 && numbers.size() != 3)
    fail_at(value.where, path,
            fmt::format("a point has 2 or 3 numbers, not {}: [x, y] or [x, y, z]", numbers.size()));
  for (const double number : numbers)
    if (!std::isfinite(number)) fail_at(value.where, path, "a coordinate must be a finite number");
  out = {.at = {numbers[0], numbers[1]}};
  if (numbers.size() == 3) out.z = numbers[2];
}

Value write_value(const SurfacePoint& point) {
  Value::Array numbers{write_value(point.at.x), write_value(point.at.y)};
  if (point.z) numbers.push_back(write_value(*point.z));
  return {numbers};
}

std::string type_name(const SurfacePoint&) { return "[x, y] or [x, y, z]"; }

void read_value(const Value& value, const std::string& path, SweepNode& out) {
  if (value.array()) {
    read_value(value, path, out.at);
    return;
  }
  read_fields(value, path, out);
  if (!value.find("at"))
    fail_at(value.where, path, "\"at\" is missing; write at = [x, y] or [x, y, z]");
}

Value write_value(const SweepNode& node) {
  if (node.scale == 1 && node.profile.empty()) return write_value(node.at);
  // `at` is written also where it is that of a node by default.
  Value::Table table{{"at", write_value(node.at)}};
  const Value fields = write_fields(node);
  for (const Member& member : *fields.table())
    if (member.key != "at") table.push_back(member);
  return {table};
}

std::string type_name(const SweepNode&) {
  return "[x, y], [x, y, z] or { at = [x, y], scale = 1, profile = [[across, up], ...] }";
}

void read_value(const Value& value, const std::string& path, SweepArc& out) {
  std::vector<int> nodes;
  read_value(value, path, nodes);
  if (nodes.size() != 2)
    fail_at(value.where, path, fmt::format("an arc has 2 nodes, not {}: [from, to]", nodes.size()));
  out = {nodes[0], nodes[1]};
}

Value write_value(const SweepArc& arc) {
  return {Value::Array{write_value(arc.from), write_value(arc.to)}};
}

std::string type_name(const SweepArc&) { return "[from, to]"; }

}  // namespace talus
