// What a command line asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "talus/scene/document.h"

namespace talus::cli {

// A value that an option puts into the document of a recipe or of parameters.
struct Setting {
  std::string path;   // "operation.0.tiles.n"
  std::string text;   // "7"
  std::string where;  // "-n 7"
};

struct Command {
  std::string verb;
  std::string subject;  // the positional argument; empty if none was given
  std::optional<std::filesystem::path> output;
  std::vector<Setting> options;       // values that options stand for
  std::vector<std::string> settings;  // --set path=value, in order, after `options`
  std::optional<std::filesystem::path> save_scene;
  std::optional<double> section;  // height of a cut to draw
  std::optional<int> threads;
  std::optional<std::uint64_t> memory_limit;  // bytes
  bool preview = true;
  bool cache = true;
  bool quiet = false;
  bool json = false;
};

// One option or argument as completion and the manual show it.
struct OptionHelp {
  std::vector<std::string> names;    // "-o", "--output"; one bare word if positional
  std::string value;                 // what follows it: "DIR"; empty for a switch
  std::vector<std::string> choices;  // if only these may follow
  std::string help;
  bool positional = false;
};

struct VerbHelp {
  std::string name;
  std::string help;
  std::string footer;  // examples
  std::vector<OptionHelp> options;
};

struct CommandLineHelp {
  std::string help;
  std::string footer;
  std::vector<OptionHelp> options;
  std::vector<VerbHelp> verbs;
};

// The command to run, or nothing if the text the user asked for (help, version) was printed to
// standard output. Throws `Error` (usage).
std::optional<Command> parse_command_line(int argc, const char* const* argv);

// The same tree that is parsed.
CommandLineHelp describe_command_line();

}  // namespace talus::cli
