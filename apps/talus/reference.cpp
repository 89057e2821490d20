#include <fmt/format.h>

#include "apps/talus/texts.h"
#include "talus/scene/operation.h"
#include "talus/scene/recipe.h"

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

}  // namespace

std::string operations_page() {
  std::string out =
      "# Operations\n\n"
      "Every key a recipe may have. This page is made by the program from the lists that also\n"
      "validate a recipe; change those, not this page.\n\n"
      "A recipe is a TOML file. Keys that are not given have their default. Lengths are in "
      "metres,\n"
      "angles in degrees. `--set path=value` sets a key by its path, such as\n"
      "`operation.0.tiles.n=7`.\n\n"
      "| key | value | default | meaning |\n|---|---|---|---|\n"
      "| `seed` | integer, at least 0 | `1` | which of the possible scenes this is |\n"
      "| `[[operation]]` | table with a `type` | | what is done, in order |\n\n";
  for (const OperationType& type : operation_types())
    out += fmt::format("## `{}`\n\nAn operation that {}.\n\n{}\n", type.name, type.help,
                       keys_table(list_keys(type)));
  out += fmt::format(
      "## Supports\n\nA mesh file, `{{ mesh = \"angel.ply\", up = \"z\", scale = 0.1 }}`:\n\n{}\n"
      "or a shape, `{{ shape = \"sphere\", radius = 2 }}`, or shapes combined,\n"
      "`{{ shape = \"join\", blend = 0.1, parts = [{{ shape = \"box\" }}, ...] }}`:\n\n",
      keys_table(list_keys(MeshSource{})));
  for (const ShapeHelp& shape : list_shapes())
    out += fmt::format("### `{}`\n\n{}.\n\n{}\n", shape.name, shape.help, keys_table(shape.keys));
  out += fmt::format("## `[output]`\n\n{}\n## `[view]`\n\n{}",
                     keys_table(list_keys(OutputParams{})), keys_table(list_keys(ViewParams{})));
  return out;
}

}  // namespace talus::cli
