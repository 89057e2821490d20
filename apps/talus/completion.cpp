#include <fmt/format.h>

#include <algorithm>

#include "apps/talus/texts.h"
#include "talus/base/error.h"

namespace talus::cli {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view separator = " ") {
  return fmt::format("{}", fmt::join(words, separator));
}

std::vector<std::string> verb_names(const CommandLineHelp& help) {
  std::vector<std::string> names;
  for (const VerbHelp& verb : help.verbs) names.push_back(verb.name);
  return names;
}

std::vector<std::string> option_names(const std::vector<OptionHelp>& options) {
  std::vector<std::string> names;
  for (const OptionHelp& option : options)
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// Text between single quotes of a shell.
std::string quoted(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (special.find(c) != std::string_view::npos)
      out += {'\\', c};
    else
      out += c;
  }
  return fmt::format("'{}'", out);
}

// What may stand for a verb's positional argument; empty means files.
std::string positional_words(const VerbHelp& verb) {
  return verb.name == "completion" ? "bash zsh fish" : "";
}

std::string bash_script(const CommandLineHelp& help) {
  std::string out =
      "# bash completion for talus, made by 'talus completion bash'\n"
      "_talus() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local words=\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n";
  out += fmt::format("    words='{} {}'\n", joined(verb_names(help)),
                     joined(option_names(help.options)));
  out += "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n    return\n  fi\n";
  out += "  case ${COMP_WORDS[1]} in\n";
  for (const VerbHelp& verb : help.verbs) {
    out += fmt::format("    {})\n      case $before in\n", verb.name);
    for (const OptionHelp& option : verb.options) {
      if (option.positional || option.value.empty()) continue;
      // Files complete by themselves where there are no words.
      out += fmt::format(
          "        {}) COMPREPLY=($({} -- \"$word\")); return ;;\n", joined(option.names, "|"),
          option.choices.empty() ? "compgen -f"
                                 : fmt::format("compgen -W '{}'", joined(option.choices)));
    }
    out += "      esac\n";
    out += fmt::format("      words='{}'\n      ;;\n", joined(option_names(verb.options)));
  }
  out += "  esac\n  if [[ $word == -* ]]; then\n";
  out += "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n";
  for (const VerbHelp& verb : help.verbs)
    if (const std::string words = positional_words(verb); !words.empty())
      out += fmt::format(
          "  elif [[ ${{COMP_WORDS[1]}} == {} ]]; then\n"
          "    COMPREPLY=($(compgen -W '{}' -- \"$word\"))\n",
          verb.name, words);
  out += "  else\n    COMPREPLY=($(compgen -f -- \"$word\"))\n  fi\n}\n";
  return out + "complete -o filenames -F _talus talus\n";
}

std::string zsh_option(const OptionHelp& option) {
  std::string out;
  for (const std::string& name : option.names) {
    out += fmt::format("      {}", quoted(fmt::format("*{}[{}]", name, option.help), ""));
    if (!option.value.empty()) {
      out.pop_back();
      std::string value = option.value;
      std::replace(value.begin(), value.end(), ':', ' ');
      out += fmt::format(
          ":{}:{}'", value,
          option.choices.empty() ? "_files" : fmt::format("({})", joined(option.choices)));
    }
    out += " \\\n";
  }
  return out;
}

std::string zsh_script(const CommandLineHelp& help) {
  std::string out =
      "#compdef talus\n"
      "# zsh completion for talus, made by 'talus completion zsh'\n"
      "_talus() {\n  local -a verbs\n  verbs=(\n";
  for (const VerbHelp& verb : help.verbs)
    out += "    " + quoted(fmt::format("{}:{}", verb.name, verb.help), "") + "\n";
  out += "  )\n  if (( CURRENT == 2 )); then\n    _describe verb verbs\n    return\n  fi\n";
  out += "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n";
  for (const VerbHelp& verb : help.verbs) {
    out += fmt::format("    {})\n      _arguments \\\n", verb.name);
    for (OptionHelp option : verb.options) {
      // Brackets end a help text, a colon starts the next part.
      std::string text;
      for (const char c : option.help)
        text += c == '[' || c == ']' || c == ':' ? std::string{'\\', c} : std::string{c};
      option.help = text;
      if (!option.positional) out += zsh_option(option);
    }
    const std::string words = positional_words(verb);
    out += fmt::format("      '*:argument:{}'\n      ;;\n",
                       words.empty() ? "_files" : fmt::format("({})", words));
  }
  return out + "  esac\n}\n_talus \"$@\"\n";
}

std::string fish_script(const CommandLineHelp& help) {
  std::string out = "# fish completion for talus, made by 'talus completion fish'\n";
  for (const VerbHelp& verb : help.verbs) {
    out += fmt::format("complete -c talus -f -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                       quoted(verb.help, "\\"));
    const std::string here = fmt::format("-n '__fish_seen_subcommand_from {}'", verb.name);
    for (const OptionHelp& option : verb.options) {
      if (option.positional) continue;
      out += fmt::format("complete -c talus {}", here);
      for (const std::string& name : option.names)
        out += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                      : fmt::format(" -s {}", name.substr(1));
      if (!option.value.empty()) out += " -r";
      if (!option.choices.empty()) out += fmt::format(" -f -a '{}'", joined(option.choices));
      out += fmt::format(" -d {}\n", quoted(option.help, "\\"));
    }
    if (const std::string words = positional_words(verb); !words.empty())
      out += fmt::format("complete -c talus {} -f -a '{}'\n", here, words);
  }
  return out;
}

}  // namespace

std::string completion_script(const CommandLineHelp& help, std::string_view shell) {
  if (shell == "bash") return bash_script(help);
  if (shell == "zsh") return zsh_script(help);
  if (shell == "fish") return fish_script(help);
  throw usage_error(
      fmt::format("there is no completion for \"{}\"; name bash, zsh or fish", shell));
}

}  // namespace talus::cli
