// A recipe before it means anything: a tree of values, each with the place it was written at.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace talus {

struct Member;

// One value of a document. Tables keep the order in which their keys were written.
struct Value {
  using Array = std::vector<Value>;
  using Table = std::vector<Member>;

  std::variant<bool, std::int64_t, double, std::string, Array, Table> data = Table{};
  std::string where;  // "scene.toml:12", "--set seed=3", or empty if made by the program

  const Array* array() const { return std::get_if<Array>(&data); }
  const Table* table() const { return std::get_if<Table>(&data); }
  const std::string* text() const { return std::get_if<std::string>(&data); }
  // The member of that name; null if this is no table or has none.
  const Value* find(std::string_view key) const;
};

struct Member {
  std::string key;
  Value value;
};

// Whether two values say the same; where they were written does not count.
bool operator==(const Value& a, const Value& b);

// Reads TOML. `name` is what places are named after, for example the file's name. Throws `Error`
// (usage) with name and line for a syntax error, and for dates and times, which no recipe uses.
Value parse_document(std::string_view text, const std::string& name);

// TOML that `parse_document` reads as the same tree. Tables at the top, and arrays of tables
// there, get headers; everything below is written inline.
std::string to_toml(const Value& document);

// One value as it stands on the right of a TOML key.
std::string to_text(const Value& value);

// Replaces the value at a dotted path ("operation.0.tiles.n"; numbers count array elements from 0)
// or adds it, with the tables above it. `text` is a TOML value; anything else is taken as a string,
// so that quotes may be left out. The new value's place is `where`. Throws `Error` (usage) if the
// path leads through a value that has no members, or names an element that is not there.
void set_value(Value& document, std::string_view path, std::string_view text,
               const std::string& where);

// Makes `where` the place of a value and of everything in it.
void set_place(Value& value, const std::string& where);

// Applies "path=value" as above. Throws `Error` (usage) also if there is no "=" or no path.
void apply_setting(Value& document, std::string_view assignment);

}  // namespace talus
