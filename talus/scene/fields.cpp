#include "talus/scene/fields.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

[[noreturn]] void fail_type(const Value& value, const std::string& path, std::string_view wanted) {
  const std::string shown = value.table() ? "a table" : value.array() ? "a list" : to_text(value);
  fail_at(value.where, path, fmt::format("{} is wrong here; write {}", shown, wanted));
}

template <class V>
void read_vector(const Value& value, const std::string& path, V& out, std::string_view wanted) {
  const Value::Array* array = value.array();
  if (!array || array->size() != static_cast<std::size_t>(V::length()))
    fail_type(value, path, wanted);
  for (int axis = 0; axis < V::length(); ++axis)
    read_value((*array)[static_cast<std::size_t>(axis)], path, out[axis]);
}

}  // namespace

void fail_at(const std::string& where, const std::string& path, const std::string& message) {
  std::string line;
  for (const std::string& part : {where, path})
    if (!part.empty()) line += part + ": ";
  throw usage_error(line + message);
}

std::string joined_path(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : name.empty() ? path : fmt::format("{}.{}", path, name);
}

void read_value(const Value& value, const std::string& path, bool& out) {
  const bool* flag = std::get_if<bool>(&value.data);
  if (!flag) fail_type(value, path, "true or false");
  out = *flag;
}

void read_value(const Value& value, const std::string& path, std::int64_t& out) {
  const std::int64_t* integer = std::get_if<std::int64_t>(&value.data);
  if (!integer) fail_type(value, path, "an integer");
  out = *integer;
}

void read_value(const Value& value, const std::string& path, double& out) {
  if (const double* number = std::get_if<double>(&value.data))
    out = *number;
  else if (const std::int64_t* integer = std::get_if<std::int64_t>(&value.data))
    out = static_cast<double>(*integer);
  else
    fail_type(value, path,
              value.text() ? "a number without quotes and unit; lengths are in metres, angles in "
                             "degrees"
                           : "a number");
}

void read_value(const Value& value, const std::string& path, std::string& out) {
  if (!value.text()) fail_type(value, path, "text in quotes");
  out = *value.text();
}

void read_value(const Value& value, const std::string& path, std::filesystem::path& out) {
  if (!value.text() || value.text()->empty()) fail_type(value, path, "a file name in quotes");
  out = *value.text();
}

void read_value(const Value& value, const std::string& path, Vec2& out) {
  read_vector(value, path, out, type_name(out));
}

void read_value(const Value& value, const std::string& path, Vec3& out) {
  read_vector(value, path, out, type_name(out));
}

void read_value(const Value& value, const std::string& path, Box2& out) {
  const Value::Array* array = value.array();
  if (!array || array->size() != 4) fail_type(value, path, type_name(out));
  double* const numbers[] = {&out.min.x, &out.min.y, &out.max.x, &out.max.y};
  for (std::size_t i = 0; i < 4; ++i) read_value((*array)[i], path, *numbers[i]);
  if (!(out.min.x < out.max.x && out.min.y < out.max.y))
    fail_at(value.where, path, "the rectangle is empty; give its lower corner first");
}

void read_value(const Value& value, const std::string& path, Range& out) {
  if (const Value::Array* array = value.array()) {
    if (array->size() != 2) fail_type(value, path, "[min, max] or one number");
    read_value((*array)[0], path, out.min);
    read_value((*array)[1], path, out.max);
  } else {
    read_value(value, path, out.min);
    out.max = out.min;
  }
}

void read_value(const Value& value, const std::string& path, RelativeLength& out) {
  if (const std::string* text = value.text()) {
    try {
      out = parse_relative_length(*text);
    } catch (const Error& error) {
      fail_at(value.where, path, error.what());
    }
  } else {
    out.unit = RelativeLength::Unit::metres;
    read_value(value, path, out.value);
  }
}

Value write_value(bool value) { return {value}; }
Value write_value(std::int64_t value) { return {value}; }
Value write_value(double value) { return {value}; }
Value write_value(const std::string& value) { return {value}; }
Value write_value(const std::filesystem::path& value) { return {value.string()}; }
Value write_value(const Vec2& value) { return {Value::Array{{value.x}, {value.y}}}; }
Value write_value(const Vec3& value) { return {Value::Array{{value.x}, {value.y}, {value.z}}}; }
Value write_value(const Box2& value) {
  return {Value::Array{{value.min.x}, {value.min.y}, {value.max.x}, {value.max.y}}};
}
Value write_value(const Range& value) {
  if (value.min == value.max) return {value.min};
  return {Value::Array{{value.min}, {value.max}}};
}
Value write_value(const RelativeLength& value) {
  if (value.unit == RelativeLength::Unit::metres) return {value.value};
  return {to_string(value)};
}

std::string type_name(bool) { return "true or false"; }
std::string type_name(std::int64_t) { return "integer"; }
std::string type_name(double) { return "number"; }
std::string type_name(const std::string&) { return "text"; }
std::string type_name(const std::filesystem::path&) { return "file"; }
std::string type_name(const Vec2&) { return "[x, y]"; }
std::string type_name(const Vec3&) { return "[x, y, z]"; }
std::string type_name(const Box2&) { return "[x0, y0, x1, y1]"; }
std::string type_name(const Range&) { return "number or [min, max]"; }
std::string type_name(const RelativeLength&) { return "length or percentage"; }

namespace detail {

std::string allowed_text(const Field& field) {
  if (std::isfinite(field.min) && std::isfinite(field.max))
    return fmt::format("{} to {}", field.min, field.max);
  if (std::isfinite(field.min)) return fmt::format("at least {}", field.min);
  if (std::isfinite(field.max)) return fmt::format("at most {}", field.max);
  return {};
}

void check_keys(const Value& table, const std::string& path, std::span<const std::string> names) {
  if (!table.table()) fail_type(table, path, "a table");
  for (const Member& member : *table.table())
    if (std::find(names.begin(), names.end(), member.key) == names.end())
      fail_at(member.value.where, path,
              fmt::format("unknown key \"{}\"; {}", member.key, suggest(member.key, names)));
}

}  // namespace detail

}  // namespace talus
