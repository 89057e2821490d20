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

}  // namespace talus
