// What a recipe can do: the operations and their keys.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "talus/base/describe.h"
#include "talus/piles/pile.h"
#include "talus/rocks/tile_params.h"
#include "talus/scene/fields.h"
#include "talus/scene/support_source.h"

namespace talus {

// Fills a support with the stones of a tile set.
struct PileOperation {
  std::string name = "stones";
  SupportSource support;
  TileParams tiles;
  PileParams pile;

  static constexpr std::string_view kName = "pile";
  static constexpr std::string_view kHelp = "fills a mesh or a shape with stones that touch";
  static void describe(auto& p, auto&& field) {
    field(p.support, Field{.name = "support", .help = "what is filled"});
    PileParams::describe(p.pile, field);
    field(p.tiles, Field{.name = "tiles", .help = "the stones it is filled with"});
    field(p.name, Field{.name = "name", .help = "what messages and the report call it"});
  }
};

using Operation = std::variant<PileOperation>;

// Throws `Error` (usage) for what single keys cannot tell: a missing support, tile parameters that
// contradict each other.
void check(const PileOperation& operation);

// One line of the table of operations.
struct OperationType {
  std::string_view name;
  std::string_view help;
  Operation defaults;
};

// Every operation there is.
std::span<const OperationType> operation_types();

// The keys below `type` in an [[operation]] table.
std::vector<KeyHelp> list_keys(const OperationType& type);

void read_value(const Value& value, const std::string& path, Operation& out);
Value write_value(const Operation& operation);
std::string type_name(const Operation&);

}  // namespace talus
