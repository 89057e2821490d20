// Texts made from the command line's own description, so that they cannot drift from it.
#pragma once

#include <string>
#include <string_view>

#include "apps/talus/command.h"

namespace talus::cli {

// A completion script. Throws `Error` (usage) unless `shell` is bash, zsh or fish.
std::string completion_script(const CommandLineHelp& help, std::string_view shell);

// The manual page, in roff.
std::string manual_page(const CommandLineHelp& help);

// docs/operations.md: every operation, key and shape of a recipe.
std::string operations_page();

}  // namespace talus::cli
