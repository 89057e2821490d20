// One list of a parameter struct's fields serves validation, recipes, flags, help and docs.
//
//   struct TileParams {
//     int n = 5;
//     static void describe(auto& p, auto&& field) {
//       field(p.n, Field{.name = "n", .help = "cells per cube edge", .min = 5, .max = 16});
//     }
//   };
//
// A field may itself be a described struct. Defaults are those of a value-initialised struct.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "talus/base/error.h"
#include "talus/base/vec.h"

namespace talus {

struct Field {
  std::string_view name;
  std::string_view help;       // one sentence, no final stop
  std::string_view unit = {};  // empty: a plain number, or SI as `help` says
  double min = -std::numeric_limits<double>::infinity();  // both ends allowed
  double max = std::numeric_limits<double>::infinity();
};

template <class T>
concept Described = requires(T& t) {
  T::describe(t, [](auto&, const Field&) {});
};

// A closed range of values to draw from or to vary between.
struct Range {
  double min = 0;
  double max = 0;
  bool operator==(const Range&) const = default;
};

// A length in metres, or as a fraction of the longest side of what it is applied to.
struct RelativeLength {
  enum class Unit { metres, fraction };
  double value = 0;
  Unit unit = Unit::metres;

  double in_metres(double longest_side) const {
    return unit == Unit::metres ? value : value * longest_side;
  }
  bool operator==(const RelativeLength&) const = default;
};

// "0.25" is metres, "4%" a fraction. Throws `Error` (usage).
RelativeLength parse_relative_length(std::string_view text);
std::string to_string(const RelativeLength& length);

namespace detail {

void check_number(std::string_view path, const Field& f, double value);

template <class T>
void check_field(const std::string& path, const Field& f, const T& value) {
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
    check_number(path, f, static_cast<double>(value));
  } else if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
    for (int axis = 0; axis < T::length(); ++axis) check_number(path, f, value[axis]);
  } else if constexpr (std::is_same_v<T, Range>) {
    check_number(path, f, value.min);
    check_number(path, f, value.max);
    if (value.min > value.max)
      throw usage_error(fmt::format("{}: range [{}, {}] is reversed; give the smaller value first",
                                    path, value.min, value.max));
  } else if constexpr (std::is_same_v<T, RelativeLength>) {
    check_number(path, f, value.value);
  }
}

template <class T>
void check_field(const std::string& path, const Field& f, const std::optional<T>& value) {
  if (value) check_field(path, f, *value);
}

}  // namespace detail

// Throws `Error` (usage) naming the first field outside its range. `path` is what the names are
// shown below, for example "tiles".
template <Described T>
void validate(const T& params, const std::string& path = {}) {
  T::describe(params, [&](const auto& value, const Field& f) {
    const std::string name =
        path.empty() ? std::string(f.name) : fmt::format("{}.{}", path, f.name);
    if constexpr (Described<std::remove_cvref_t<decltype(value)>>)
      validate(value, name);
    else
      detail::check_field(name, f, value);
  });
}

}  // namespace talus
