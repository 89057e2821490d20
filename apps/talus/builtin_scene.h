// The scene that `talus build` makes when it is given none.
#pragma once

#include <string_view>

namespace talus::cli {

// scenes/ravine.toml, embedded at build time.
extern const std::string_view kBuiltinScene;

}  // namespace talus::cli
