// What each verb does, given a parsed command line.
#pragma once

#include "apps/talus/command.h"
#include "apps/talus/console.h"

namespace talus::cli {

// Runs the command's verb; results go to files and standard output. Throws `Error`, `Cancelled`.
void run(const Command& command, Console& console);

}  // namespace talus::cli
