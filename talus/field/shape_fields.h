// How shapes describe their places and lengths.
#pragma once

#include <string_view>

#include "talus/base/describe.h"

namespace talus {

// A coordinate and a length within bounds that keep every sum finite and exact enough.
constexpr Field place_field(std::string_view name, std::string_view help) {
  return {.name = name, .help = help, .unit = "m", .min = -1e9, .max = 1e9};
}
constexpr Field extent_field(std::string_view name, std::string_view help) {
  return {.name = name, .help = help, .unit = "m", .min = 1e-6, .max = 1e9};
}

}  // namespace talus
