#include "talus/scene/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "talus/base/error.h"

namespace talus {
namespace {

std::string place(const std::string& name, const toml::source_region& region) {
  return fmt::format("{}:{}", name, region.begin.line);
}

Value from_toml(const toml::node& node, const std::string& name) {
  Value value{.where = place(name, node.source())};
  if (const auto* flag = node.as_boolean()) {
    value.data = flag->get();
  } else if (const auto* integer = node.as_integer()) {
    value.data = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* array = node.as_array()) {
    Value::Array elements;
    for (const toml::node& element : *array) elements.push_back(from_toml(element, name));
    value.data = std::move(elements);
  } else if (const auto* table = node.as_table()) {
    // toml++ sorts by name; put the keys back in the order of the text.
    std::vector<std::pair<toml::source_position, Member>> members;
    for (const auto& [key, member] : *table) {
      Value child = from_toml(member, name);
      child.where = place(name, key.source());
      members.push_back({key.source().begin, {std::string(key.str()), std::move(child)}});
    }
    std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first.line, a.first.column) < std::tie(b.first.line, b.first.column);
    });
    Value::Table sorted;
    for (auto& [position, member] : members) sorted.push_back(std::move(member));
    value.data = std::move(sorted);
  } else {
    throw usage_error(value.where + ": dates and times have no use in a recipe; quote it as text");
  }
  return value;
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? std::string(key) : in_quotes(key);
}

// Shortest digits that read back as the same number, always recognisable as no integer.
std::string number_text(double number) {
  std::string text = fmt::format("{}", number);
  if (std::isfinite(number) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

bool is_table_array(const Value& value) {
  const Value::Array* array = value.array();
  return array && !array->empty() &&
         std::all_of(array->begin(), array->end(), [](const Value& v) { return v.table(); });
}

void write_members(std::string& out, const Value::Table& table) {
  for (const Member& member : table)
    out += fmt::format("{} = {}\n", key_text(member.key), to_text(member.value));
}

// Takes what a user typed after "=": a TOML value if it is one, else the characters themselves.
Value parse_value(std::string_view text, const std::string& where) {
  Value value;
  try {
    const toml::table table = toml::parse(fmt::format("value = {}\n", text));
    const toml::node* node = table.get("value");
    const bool is_date = node && (node->is_date() || node->is_time() || node->is_date_time());
    value = table.size() == 1 && !is_date ? from_toml(*node, where) : Value{std::string(text)};
  } catch (const toml::parse_error&) {
    value.data = std::string(text);
  }
  return value;
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  const Table* members = table();
  if (!members) return nullptr;
  for (const Member& member : *members)
    if (member.key == key) return &member.value;
  return nullptr;
}

bool operator==(const Value& a, const Value& b) {
  const Value::Table* left = a.table();
  const Value::Table* right = b.table();
  if (!left || !right) return a.data == b.data;
  // Tables are equal whatever the order of their keys.
  return left->size() == right->size() &&
         std::all_of(left->begin(), left->end(), [&](const Member& member) {
           const Value* other = b.find(member.key);
           return other && *other == member.value;
         });
}

bool operator==(const Member& a, const Member& b) { return a.key == b.key && a.value == b.value; }

Value parse_document(std::string_view text, const std::string& name) {
  try {
    return from_toml(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw usage_error(fmt::format("{}: {}", place(name, error.source()), error.description()));
  }
}

std::string to_text(const Value& value) {
  struct Writer {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(const Value::Array& array) const {
      // Tables get a line each, so that a shape of many parts can be read.
      const bool lines = is_table_array({array});
      std::string out = "[";
      for (std::size_t i = 0; i < array.size(); ++i)
        out += (lines ? "\n  " : i > 0 ? ", " : "") + to_text(array[i]) + (lines ? "," : "");
      return out + (lines ? "\n]" : "]");
    }
    std::string operator()(const Value::Table& table) const {
      std::string out;
      for (const Member& member : table)
        out += fmt::format("{} {} = {}", out.empty() ? "" : ",", key_text(member.key),
                           to_text(member.value));
      return out.empty() ? "{}" : "{" + out + " }";
    }
  };
  return std::visit(Writer{}, value.data);
}

std::string to_toml(const Value& document) {
  std::string out;
  Value::Table plain;
  std::string headed;
  for (const Member& member : std::get<Value::Table>(document.data)) {
    if (const Value::Table* table = member.value.table()) {
      headed += fmt::format("\n[{}]\n", key_text(member.key));
      write_members(headed, *table);
    } else if (is_table_array(member.value)) {
      for (const Value& element : *member.value.array()) {
        headed += fmt::format("\n[[{}]]\n", key_text(member.key));
        write_members(headed, *element.table());
      }
    } else {
      plain.push_back(member);
    }
  }
  write_members(out, plain);
  return out + headed;
}

void set_value(Value& document, std::string_view path, std::string_view text,
               const std::string& where) {
  Value* value = &document;
  for (std::string_view rest = path; !rest.empty();) {
    const std::string_view key = rest.substr(0, rest.find('.'));
    rest.remove_prefix(std::min(rest.size(), key.size() + 1));
    const std::string_view done(path.data(), static_cast<std::size_t>(key.data() - path.data()));
    const std::string above =
        done.empty() ? "the recipe" : std::string(done.substr(0, done.size() - 1));
    if (auto* array = std::get_if<Value::Array>(&value->data)) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
      if (error != std::errc() || end != key.data() + key.size() || index >= array->size())
        throw usage_error(fmt::format(
            "{}: {} has no element \"{}\"; {}", where, above, key,
            array->empty() ? "it is empty" : fmt::format("it has 0 to {}", array->size() - 1)));
      value = &(*array)[index];
    } else if (auto* table = std::get_if<Value::Table>(&value->data)) {
      const auto member =
          std::find_if(table->begin(), table->end(), [&](const Member& m) { return m.key == key; });
      value = member != table->end()
                  ? &member->value
                  : &table->emplace_back(Member{std::string(key), {.where = where}}).value;
    } else {
      throw usage_error(
          fmt::format("{}: {} is {}, which has no \"{}\"", where, above, to_text(*value), key));
    }
  }
  *value = parse_value(text, where);
  set_place(*value, where);
}

void set_place(Value& value, const std::string& where) {
  value.where = where;
  if (auto* array = std::get_if<Value::Array>(&value.data))
    for (Value& element : *array) set_place(element, where);
  if (auto* table = std::get_if<Value::Table>(&value.data))
    for (Member& member : *table) set_place(member.value, where);
}

void apply_setting(Value& document, std::string_view assignment) {
  const std::string where = fmt::format("--set {}", assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw usage_error(where + ": write path=value, for example seed=3");
  set_value(document, assignment.substr(0, equals), assignment.substr(equals + 1), where);
}

}  // namespace talus
