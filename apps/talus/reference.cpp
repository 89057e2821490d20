#include <fmt/format.h>

#include "apps/talus/texts.h"
#include "talus/scene/operation.h"
#include "talus/scene/recipe.h"
#include "talus/terrain/material.h"

namespace talus::cli {
namespace {

std::string keys_table(const std::vector<KeyHelp>& keys) {
  const auto cell = [](std::string_view text) {
    // A bar would end the cell.
    std::string escaped;
    for (const char c : text) {
      if (c == '|') escaped += '\\';
      escaped += c;
    }
    return escaped;
  };
  std::string out = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const KeyHelp& key : keys) {
    std::string value = key.type;
    if (!key.allowed.empty()) value += fmt::format(", {}", key.allowed);
    if (!key.unit.empty()) value += fmt::format(" ({})", key.unit);
    out +=
        fmt::format("| `{}` | {} | {} | {} |\n", key.path, cell(value),
                    key.default_value.empty() ? "" : fmt::format("`{}`", cell(key.default_value)),
                    cell(key.help));
  }
  return out;
}

std::string_view kind_name(MaterialKind kind) {
  switch (kind) {
    case MaterialKind::solid:
      return "solid";
    case MaterialKind::granular:
      return "granular";
    case MaterialKind::liquid:
      return "liquid";
    case MaterialKind::empty:
      return "nothing";
  }
  return "";
}

// The keys of a recipe that stand outside its tables.
std::vector<KeyHelp> plain_keys() {
  std::vector<KeyHelp> keys = list_keys(Recipe{});
  std::erase_if(keys, [](const KeyHelp& key) { return key.path.find('.') != std::string::npos; });
  for (KeyHelp& key : keys)
    if (key.path == "operation")
      key = {.path = "[[operation]]", .type = "tables with a `type`", .help = key.help};
  return keys;
}

// Every table of a recipe with its keys.
std::string table_sections() {
  std::string out;
  const Recipe defaults;
  Recipe::describe(defaults, [&]<class V>(const V& value, const Field& f) {
    if constexpr (Described<V>)
      out += fmt::format("## `[{}]`\n\nA table for {}.\n\n{}\n", f.name, f.help,
                         keys_table(list_keys(value)));
  });
  return out;
}

std::string operation_sections() {
  std::string out;
  for (const OperationType& type : operation_types())
    out += fmt::format("## `{}`\n\nAn operation that {}.\n\n{}\n", type.name, type.help,
                       keys_table(list_keys(type)));
  return out;
}

std::string support_sections() {
  std::string out = fmt::format(
      "## Supports\n\nA mesh file, `{{ mesh = \"angel.ply\", up = \"z\", scale = 0.1 }}`:\n\n{}\n"
      "or a shape, `{{ shape = \"sphere\", radius = 2 }}`, or shapes combined,\n"
      "`{{ shape = \"join\", blend = 0.1, parts = [{{ shape = \"box\" }}, ...] }}`:\n\n",
      keys_table(list_keys(MeshSource{})));
  for (const ShapeHelp& shape : list_shapes())
    out += fmt::format("### `{}`\n\n{}.\n\n{}\n", shape.name, shape.help, keys_table(shape.keys));
  out += fmt::format(
      "### A formula\n\nA condition on x, y and z, within a box that must be given,\n"
      "`{{ formula = \"z < 0.2 * sin(x)\", min = [0, 0, -1], max = [4, 4, 1] }}`;\n"
      "[piles.md](piles.md) has its language:\n\n{}\n",
      keys_table(list_keys(FormulaSource{})));
  out += fmt::format(
      "### Between two rasters\n\nFrom the heights of one raster to those of another of the same "
      "cells,\n`{{ lower = \"bed.tif\", upper = \"top.tif\" }}`; where a height is unknown "
      "nothing is inside:\n\n{}\n",
      keys_table(list_keys(HeightsSource{})));
  return out;
}

std::string material_section() {
  std::string out =
      "## Materials\n\n"
      "Bedrock holds itself wherever it is put, also in the air. Every other material is a\n"
      "deposit: after each operation it comes down onto what is below it in its column, and the\n"
      "deposits there come to lie in the order of this table. A sphere of rocks high above a\n"
      "slope lies on the slope afterwards.\n\n"
      "| material | kind | steepest slope it rests on |\n|---|---|---|\n";
  for (const MaterialInfo& info : material_infos())
    out += fmt::format("| `{}` | {} | {} |\n", info.name, kind_name(info.kind),
                       info.kind == MaterialKind::granular
                           ? fmt::format("{} degrees", info.repose_angle_deg)
                           : "");
  return out + "\n";
}

}  // namespace

std::string operations_page() {
  std::string out =
      "# Operations\n\n"
      "Every key a recipe may have. This page is made by the program from the lists that also\n"
      "validate a recipe; change those, not this page.\n\n"
      "A recipe is a TOML file. Keys that are not given have their default. Lengths are in "
      "metres,\n"
      "angles in degrees. `--set path=value` sets a key by its path, such as\n"
      "`terrain.cell=0.25` or, in the first operation, `operation.0.tiles.n=7`.\n\n";
  out += keys_table(plain_keys()) + "\n" + operation_sections() + support_sections() +
         material_section() + table_sections();
  out.pop_back();
  return out;
}

}  // namespace talus::cli
