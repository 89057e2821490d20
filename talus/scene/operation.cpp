#include "talus/scene/operation.h"

#include <algorithm>
#include <array>

namespace talus {
namespace {

template <class Params>
OperationType entry() {
  return {Params::kName, Params::kHelp, Params{}};
}

}  // namespace

std::span<const OperationType> operation_types() {
  static const std::array types = {
      entry<PileOperation>(),
  };
  return types;
}

void check(const PileOperation& operation) {
  const auto* source = std::get_if<MeshSource>(&operation.support);
  if (source && source->mesh.empty())
    throw usage_error("\"support\" is missing; write support = " + type_name(operation.support));
  if (operation.name.empty()) throw usage_error("\"name\" is empty; give a name or leave it out");
  validate_tiles(operation.tiles);
}

std::vector<KeyHelp> list_keys(const OperationType& type) {
  std::vector<KeyHelp> keys =
      std::visit([](const auto& params) { return list_keys(params); }, type.defaults);
  // A key that must be given has no default to show.
  for (KeyHelp& key : keys)
    if (key.path == "support") key.default_value.clear();
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
  const std::string below = joined_path(path, name);
  std::visit(
      [&](auto& params) {
        read_fields(value, below, params, std::array<std::string, 1>{"type"});
        try {
          check(params);
        } catch (const Error& error) {
          fail_at(value.where, below, error.what());
        }
      },
      out);
}

Value write_value(const Operation& operation) {
  return std::visit(
      []<class Params>(const Params& params) {
        Value value = write_fields(params);
        auto& table = std::get<Value::Table>(value.data);
        table.insert(table.begin(), {"type", write_value(std::string(Params::kName))});
        return value;
      },
      operation);
}

std::string type_name(const Operation&) { return "operation"; }

}  // namespace talus
