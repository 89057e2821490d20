// Parameter structs in and out of a document, by their `describe` list.
//
// One pair of overloads, `read_value` and `write_value`, and one `type_name` make a type usable as
// a field; those for plain types, optional and repeated ones, enumerations and described structs
// are here. An enumeration needs its names:
//
//   template <> inline constexpr auto kEnumNames<Axis> = std::to_array<EnumName<Axis>>({...});
#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "talus/base/describe.h"
#include "talus/base/suggest.h"
#include "talus/scene/document.h"

namespace talus {

template <class E>
struct EnumName {
  E value;
  std::string_view name;
};

// Every value of an enumeration with its name in recipes, flags and docs.
template <class E>
inline constexpr std::array<EnumName<E>, 0> kEnumNames{};

template <class E>
concept NamedEnum = std::is_enum_v<E> &&(kEnumNames<E>.size() > 0);

// Throws `Error` (usage): "<where>: <path>: <message>", without what is empty.
[[noreturn]] void fail_at(const std::string& where, const std::string& path,
                          const std::string& message);

// "<path>.<name>", or the one that is not empty.
std::string joined_path(const std::string& path, std::string_view name);

// Each reads `value` into `out` or throws `Error` (usage) that names place, path and wanted type.
void read_value(const Value& value, const std::string& path, bool& out);
void read_value(const Value& value, const std::string& path, std::int64_t& out);
void read_value(const Value& value, const std::string& path, double& out);
void read_value(const Value& value, const std::string& path, std::string& out);
void read_value(const Value& value, const std::string& path, std::filesystem::path& out);
void read_value(const Value& value, const std::string& path, Vec2& out);
void read_value(const Value& value, const std::string& path, Vec3& out);
void read_value(const Value& value, const std::string& path, Box2& out);
void read_value(const Value& value, const std::string& path, Range& out);
void read_value(const Value& value, const std::string& path, RelativeLength& out);

Value write_value(bool value);
Value write_value(std::int64_t value);
Value write_value(double value);
Value write_value(const std::string& value);
Value write_value(const std::filesystem::path& value);
Value write_value(const Vec2& value);
Value write_value(const Vec3& value);
Value write_value(const Box2& value);
Value write_value(const Range& value);
Value write_value(const RelativeLength& value);

// What a user must write, in words for help and docs.
std::string type_name(bool);
std::string type_name(std::int64_t);
std::string type_name(double);
std::string type_name(const std::string&);
std::string type_name(const std::filesystem::path&);
std::string type_name(const Vec2&);
std::string type_name(const Vec3&);
std::string type_name(const Box2&);
std::string type_name(const Range&);
std::string type_name(const RelativeLength&);

// One key as help and docs show it.
struct KeyHelp {
  std::string path;  // below the struct listed: "stone_size", "tiles.n"
  std::string type;
  std::string unit;
  std::string allowed;               // "5 to 16", "at least 0"; empty if anything goes
  std::vector<std::string> choices;  // the values of an enumeration, else empty
  std::string default_value;         // as in TOML; empty if the key has none
  std::string help;
};

namespace detail {

template <class T>
concept PlainInteger = std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, std::int64_t>;

// "5 to 16", "at least 0" or nothing.
std::string allowed_text(const Field& field);

// Throws for the first member of `table` that is not among `names`.
void check_keys(const Value& table, const std::string& path, std::span<const std::string> names);

template <class T>
std::vector<std::string> choices(const T&) {
  std::vector<std::string> names;
  if constexpr (NamedEnum<T>)
    for (const auto& entry : kEnumNames<T>) names.emplace_back(entry.name);
  return names;
}
template <class T>
std::vector<std::string> choices(const std::optional<T>&) {
  return choices(T{});
}
template <class T>
std::vector<std::string> choices(const std::vector<T>&) {
  return choices(T{});
}

template <Described T>
std::vector<std::string> field_names(const T& params) {
  std::vector<std::string> names;
  T::describe(params, [&](const auto&, const Field& f) { names.emplace_back(f.name); });
  return names;
}

}  // namespace detail

template <detail::PlainInteger T>
void read_value(const Value& value, const std::string& path, T& out) {
  std::int64_t integer = 0;
  read_value(value, path, integer);
  if (!std::in_range<T>(integer)) {
    constexpr auto kLargest = std::numeric_limits<std::int64_t>::max();
    constexpr T kMax = std::numeric_limits<T>::max();
    fail_at(
        value.where, path,
        fmt::format("{} is out of range; it must be from {} to {}", integer,
                    std::numeric_limits<T>::min(),
                    std::cmp_greater(kMax, kLargest) ? kLargest : static_cast<std::int64_t>(kMax)));
  }
  out = static_cast<T>(integer);
}
template <detail::PlainInteger T>
Value write_value(T value) {
  if (!std::in_range<std::int64_t>(value))
    throw usage_error(fmt::format("{} is too large for a recipe; the largest integer there is {}",
                                  value, std::numeric_limits<std::int64_t>::max()));
  return write_value(static_cast<std::int64_t>(value));
}
template <detail::PlainInteger T>
std::string type_name(T) {
  return type_name(std::int64_t{});
}

// Capitals do not matter.
template <NamedEnum E>
void read_value(const Value& value, const std::string& path, E& out) {
  std::string text;
  read_value(value, path, text);
  std::vector<std::string> names;
  for (const auto& entry : kEnumNames<E>) {
    if (entry.name == lower_case(text)) {
      out = entry.value;
      return;
    }
    names.emplace_back(entry.name);
  }
  fail_at(value.where, path, fmt::format("unknown value \"{}\"; {}", text, suggest(text, names)));
}
template <NamedEnum E>
std::string_view enum_name(E value) {
  for (const auto& entry : kEnumNames<E>)
    if (entry.value == value) return entry.name;
  throw usage_error("an enumeration holds a value that it does not list");
}
template <NamedEnum E>
Value write_value(E value) {
  return write_value(std::string(enum_name(value)));
}
template <NamedEnum E>
std::string type_name(E) {
  std::string names;
  for (const auto& entry : kEnumNames<E>)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", entry.name);
  return names;
}

template <class T>
void read_value(const Value& value, const std::string& path, std::optional<T>& out) {
  read_value(value, path, out.emplace());
}
template <class T>
std::string type_name(const std::optional<T>&) {
  return type_name(T{});
}

template <class T>
void read_value(const Value& value, const std::string& path, std::vector<T>& out) {
  const Value::Array* array = value.array();
  if (!array) fail_at(value.where, path, "one value is not enough; write a list of them");
  out.clear();
  for (const Value& element : *array) read_value(element, path, out.emplace_back());
}
template <class T>
Value write_value(const std::vector<T>& values) {
  Value::Array array;
  for (const T& value : values) array.push_back(write_value(value));
  return {array};
}
template <class T>
std::string type_name(const std::vector<T>&) {
  return "list of " + type_name(T{});
}

// Reads the members of a table into the described fields of the same names; fields without a
// member keep their values. `more` are keys that the caller reads itself. Throws `Error` (usage)
// for unknown keys, wrong types and values out of range.
template <Described T>
void read_fields(const Value& table, const std::string& path, T& params,
                 std::span<const std::string> more = {}) {
  std::vector<std::string> names = detail::field_names(params);
  names.insert(names.end(), more.begin(), more.end());
  detail::check_keys(table, path, names);
  T::describe(params, [&](auto& field_value, const Field& f) {
    const Value* member = table.find(f.name);
    if (!member) return;
    const std::string name = joined_path(path, f.name);
    read_value(*member, name, field_value);
    try {
      detail::check_field(name, f, field_value);
    } catch (const Error& error) {
      fail_at(member->where, "", error.what());
    }
  });
}
template <Described T>
void read_value(const Value& value, const std::string& path, T& out) {
  read_fields(value, path, out);
}

// The table that `read_fields` turns back into `params`; fields that equal those of `defaults`
// are left out.
template <Described T>
Value write_fields(const T& params, const T& defaults = {});

namespace detail {

template <class T>
void write_field(Value::Table& table, std::string_view name, const T& value, const T& by_default) {
  Value written, unchanged;
  if constexpr (Described<T>) {
    written = write_fields(value, by_default);
  } else {
    written = write_value(value);
    unchanged = write_value(by_default);
  }
  if (written != unchanged) table.push_back({std::string(name), std::move(written)});
}
template <class T>
void write_field(Value::Table& table, std::string_view name, const std::optional<T>& value,
                 const std::optional<T>& by_default) {
  if (value && value != by_default) table.push_back({std::string(name), write_value(*value)});
}

}  // namespace detail

template <Described T>
Value write_fields(const T& params, const T& defaults) {
  // Both describe calls visit the same fields in the same order.
  std::vector<const void*> usual;
  T::describe(defaults, [&](const auto& value, const Field&) { usual.push_back(&value); });
  Value::Table table;
  std::size_t i = 0;
  T::describe(params, [&](const auto& value, const Field& f) {
    detail::write_field(table, f.name, value,
                        *static_cast<std::remove_cvref_t<decltype(value)> const*>(usual[i++]));
  });
  return {table};
}
template <Described T>
Value write_value(const T& value) {
  return write_fields(value);
}

// Every key of a described struct, nested ones below their table's name.
template <Described T>
std::vector<KeyHelp> list_keys(const T& params = {}) {
  std::vector<KeyHelp> keys;
  T::describe(params, [&]<class V>(const V& value, const Field& f) {
    if constexpr (Described<V>) {
      for (KeyHelp& key : list_keys(value)) {
        key.path = joined_path(std::string(f.name), key.path);
        keys.push_back(std::move(key));
      }
    } else {
      KeyHelp key{.path = std::string(f.name),
                  .type = type_name(value),
                  .unit = std::string(f.unit),
                  .allowed = detail::allowed_text(f),
                  .choices = detail::choices(value),
                  .help = std::string(f.help)};
      if constexpr (requires { value.has_value(); }) {
        if (value) key.default_value = to_text(write_value(*value));
      } else if (const Value written = write_value(value); written != write_value(std::string())) {
        key.default_value = to_text(written);
      }
      keys.push_back(std::move(key));
    }
  });
  return keys;
}

}  // namespace talus
