#include "talus/scene/operation.h"

#include <algorithm>
#include <array>

namespace talus {
namespace {

constexpr MaterialSet kCoverMaterials = {Material::sand, Material::soil, Material::snow};

Error missing(std::string_view key, std::string_view forms) {
  return usage_error(fmt::format("\"{}\" is missing; write {} = {}", key, key, forms));
}

// A mesh source without a name is what a missing support leaves.
void check_support(const auto& support) {
  const auto* source = std::get_if<MeshSource>(&support);
  if (source && source->mesh.empty()) throw missing("support", type_name(support));
}

void check_one(const HeightmapOperation& o) {
  if (o.file.empty()) throw missing("file", "\"FILE\"");
}
void check_one(const NoiseTerrainOperation&) {}
void check_one(const PrimitiveOperation& o) { check_support(o.support); }
void check_one(const MeshBedrockOperation& o) {
  if (o.mesh.mesh.empty()) throw missing("mesh", "\"FILE\"");
}
void check_one(const CoverOperation& o) {
  if (!kCoverMaterials.contains(o.cover.material))
    throw usage_error(fmt::format("\"material\" is {}; a cover is of sand, soil or snow",
                                  material_info(o.cover.material).name));
}
void check_one(const SculptOperation& o) {
  if (o.points.empty()) throw missing("points", "[[X, Y], [X, Y], ...]");
}
void check_one(const SweepOperation& o) {
  if (o.sweep.nodes.empty()) throw missing("nodes", "[[X, Y, Z], [X, Y, Z], ...]");
  const auto& nodes = o.sweep.nodes;
  if (o.sweep.profile.empty() && std::any_of(nodes.begin(), nodes.end(), [](const SweepNode& node) {
        return node.profile.empty();
      }))
    throw missing("profile", "[[ACROSS, UP], [ACROSS, UP], [ACROSS, UP], ...]");
  validate_sweep(o.sweep);
}
void check_region(const BrushSource& region) {
  if (region.points.empty() && !region.mask)
    throw missing("points", "[[X, Y], [X, Y], ...], or mask = \"FILE\"");
}
void check_one(const DepositOperation& o) {
  check_region(o.region);
  validate_deposit(o.deposit);
  if ((o.deposit.profile == DepositProfile::map) != o.map.has_value())
    throw usage_error("profile = \"map\" and map = \"FILE\" belong together; give both or none");
}
void check_one(const ErodeSurfaceOperation& o) { check_region(o.region); }
void check_one(const PileOperation& o) {
  check_support(o.support);
  if (const auto* layer = std::get_if<LayerSource>(&o.support))
    if (layer->material == Material::air)
      throw usage_error("\"support\" is air; name the layers to fill, for example \"rocks\"");
  if (o.name.empty()) throw usage_error("\"name\" is empty; give a name or leave it out");
  validate_tiles(o.tiles);
}

template <class Params>
OperationType entry() {
  return {Params::kName, Params::kHelp, {.params = Params{}}};
}

}  // namespace

std::span<const OperationType> operation_types() {
  static const std::array types = {
      entry<HeightmapOperation>(),   entry<NoiseTerrainOperation>(), entry<PrimitiveOperation>(),
      entry<MeshBedrockOperation>(), entry<CoverOperation>(),        entry<SculptOperation>(),
      entry<SweepOperation>(),       entry<DepositOperation>(),      entry<ErodeSurfaceOperation>(),
      entry<PileOperation>(),
  };
  return types;
}

std::string place_of(const Operation& operation) {
  const std::string_view name =
      std::visit([]<class Params>(const Params&) { return Params::kName; }, operation.params);
  return fmt::format("{}{}operation.{}", operation.where, operation.where.empty() ? "" : ": ",
                     name);
}

std::string told_at(const std::string& place, std::string_view message) {
  const std::string_view name = std::string_view(place).substr(place.rfind('.') + 1);
  if (message.starts_with(name) && message.substr(name.size()).starts_with('.'))
    return fmt::format("{}{}", place, message.substr(name.size()));
  if (message.starts_with(name) && message.substr(name.size()).starts_with(": "))
    message.remove_prefix(name.size() + 2);
  return fmt::format("{}: {}", place, message);
}

void check(const Operation& operation) {
  std::visit([](const auto& o) { check_one(o); }, operation.params);
}

std::vector<KeyHelp> list_keys(const OperationType& type) {
  std::vector<KeyHelp> keys =
      std::visit([](const auto& params) { return list_keys(params); }, type.defaults.params);
  // A key that must be given has no default to show, nor has an empty list.
  for (KeyHelp& key : keys)
    if (key.path == "support" || key.path == "file" || key.path == "mesh" ||
        key.default_value == "[]")
      key.default_value.clear();
  return keys;
}

void read_value(const Value& value, const std::string& path, Operation& out) {
  std::vector<std::string> names;
  for (const OperationType& type : operation_types()) names.emplace_back(type.name);
  const Value* type_value = value.find("type");
  if (!type_value)
    fail_at(value.where, path, fmt::format("\"type\" is missing; {}", suggest("", names)));
  std::string name;
  read_value(*type_value, joined_path(path, "type"), name);

  const auto types = operation_types();
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const OperationType& t) { return t.name == name; });
  if (type == types.end())
    fail_at(type_value->where, path,
            fmt::format("unknown operation \"{}\"; {}", name, suggest(name, names)));

  out = type->defaults;
  out.where = value.where;
  const std::string below = joined_path(path, name);
  std::visit(
      [&](auto& params) {
        read_fields(value, below, params, std::array<std::string, 1>{"type"});
        try {
          check_one(params);
        } catch (const Error& error) {
          fail_at(value.where, "", told_at(below, error.what()));
        }
      },
      out.params);
}

Value write_value(const Operation& operation) {
  return std::visit(
      []<class Params>(const Params& params) {
        Value value = write_fields(params);
        auto& table = std::get<Value::Table>(value.data);
        table.insert(table.begin(), {"type", write_value(std::string(Params::kName))});
        return value;
      },
      operation.params);
}

std::string type_name(const Operation&) { return "operation"; }

}  // namespace talus
