#include <fmt/format.h>

#include "apps/talus/texts.h"
#include "talus/scene/build.h"

namespace talus::cli {
namespace {

// Text that roff prints as it stands.
std::string roff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_start = c == '\n';
  }
  return out;
}

// Lines that keep their breaks.
std::string roff_lines(std::string_view text) { return ".nf\n" + roff(text) + "\n.fi\n"; }

std::string roff_option(const OptionHelp& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
  if (!option.positional && !option.value.empty())
    names += fmt::format(" \\fI{}\\fR", roff(option.value));
  return fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
}

std::string synopsis(const VerbHelp& verb) {
  std::string line = fmt::format(".B talus {}\n[options]", verb.name);
  for (const OptionHelp& option : verb.options)
    if (option.positional) line += fmt::format(" \\fI{}\\fR", option.names.front());
  return line + "\n.br\n";
}

}  // namespace

std::string manual_page(const CommandLineHelp& help) {
  std::string out = fmt::format(".TH TALUS 1 \"\" \"Talus {}\" \"User Commands\"\n", version());
  out += ".SH NAME\ntalus \\- natural scenes from a short recipe\n.SH SYNOPSIS\n";
  for (const VerbHelp& verb : help.verbs) out += synopsis(verb);
  out += fmt::format(".SH DESCRIPTION\n{}\n", roff(help.help));
  for (const OptionHelp& option : help.options) out += roff_option(option);
  out += ".SH VERBS\n";
  for (const VerbHelp& verb : help.verbs) {
    out += fmt::format(".SS {}\nThis verb {}.\n", verb.name, roff(verb.help));
    for (const OptionHelp& option : verb.options) out += roff_option(option);
    if (!verb.footer.empty()) out += ".PP\n" + roff_lines(verb.footer);
  }
  out += ".SH EXAMPLES AND EXIT STATUS\n" + roff_lines(help.footer);
  out +=
      ".SH ENVIRONMENT\n.TP\n.B TALUS_CACHE_DIR\n"
      "Where results of earlier runs are kept; by default\n"
      ".I $XDG_CACHE_HOME/talus\nor\n.IR ~/.cache/talus .\n";
  return out;
}

}  // namespace talus::cli
