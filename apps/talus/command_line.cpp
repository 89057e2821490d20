// The only place that knows CLI11.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <span>

#include "apps/talus/command.h"
#include "talus/base/error.h"
#include "talus/scene/build.h"
#include "talus/scene/recipe.h"

namespace talus::cli {
namespace {

constexpr std::string_view kExitStatus =
    "Exit status: 0 done; 1 the job failed (disk full, unwritable output, cancelled);\n"
    "2 wrong usage, a wrong recipe, a value out of range; 3 an input file that is missing,\n"
    "unreadable or unusable.";

constexpr std::string_view kTopFooter =
    "Examples:\n"
    "  talus build -o out/ravine                    the built-in scene\n"
    "  talus build garden.toml --set seed=7         your recipe, another seed\n"
    "  talus pile angel.ply -o out/angel            your mesh as a pile of stones\n"
    "  talus render out/angel -o angel.png          a picture of it\n"
    "'talus help VERB' tells more.\n\n";

// "stone_size" -> "--stone-size", "contacts.radius" -> "--contacts-radius".
std::string flag_name(std::string path) {
  std::replace_if(
      path.begin(), path.end(), [](char c) { return c == '_' || c == '.'; }, '-');
  if (path.size() == 1) return "-" + path;
  return path == "voxels-per-edge" ? "--voxels,--voxels-per-edge" : "--" + path;
}

std::string unquoted(const std::string& text) {
  return text.size() > 1 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

bool is_vector(const KeyHelp& key) { return key.type == "[x, y, z]"; }

// What follows a flag, in help.
std::string value_name(const KeyHelp& key) {
  if (!key.choices.empty()) return fmt::format("{}", fmt::join(key.choices, "|"));
  if (key.type == "integer") return "N";
  if (key.type == "number") return "X";
  if (key.type == "length or percentage") return "LENGTH|PERCENT";
  if (is_vector(key)) return "X,Y,Z";
  return key.type.starts_with("number or") ? "X|[MIN,MAX]" : "VALUE";
}

std::string help_text(const KeyHelp& key) {
  std::string notes = key.unit;
  const auto note = [&](const std::string& text) { notes += (notes.empty() ? "" : "; ") + text; };
  if (!key.allowed.empty()) note(key.allowed);
  if (!key.default_value.empty() && key.default_value != "false")
    note("default " + unquoted(key.default_value));
  return notes.empty() ? key.help : fmt::format("{} ({})", key.help, notes);
}

// From what follows a flag to TOML.
using ToToml = std::string (*)(const std::string&);

std::string as_typed(const std::string& text) { return text; }

// "glb,ply" -> "[\"glb\",\"ply\"]".
std::string name_list(const std::string& text) {
  std::string out;
  for (const std::string& part : CLI::detail::split(text, ','))
    out += (out.empty() ? "" : ",") + to_text({part});
  return "[" + out + "]";
}

// "1,2,3" -> "[1,2,3]"; brackets may be there already.
std::string list_text(const std::string& text) {
  return text.starts_with('[') ? text : "[" + text + "]";
}

// "2GB" in bytes.
std::uint64_t memory_size(const std::string& text) {
  try {
    std::string number = text;
    std::uint64_t bytes = 0;
    const std::string refusal = CLI::AsSizeValue(true)(number);
    if (refusal.empty() && CLI::detail::lexical_cast(number, bytes) && bytes > 0) return bytes;
  } catch (const CLI::ValidationError&) {
    // Its text says less.
  }
  throw usage_error(fmt::format(
      "--memory-limit {}: this is no size; write a whole number and B, KB, MB, GB or TB, each 1000 "
      "times the one before, such as 2GB",
      text));
}

class CommandLine {
 public:
  CommandLine()
      : app_(
            "Turns a short recipe into a natural scene: ground in layers, with caves and "
            "overhangs, and piles of stones that touch.") {
    app_.name("talus");
    app_.set_version_flag("--version", fmt::format("talus {}", version()), "print the version");
    app_.set_help_flag("-h,--help", "print this help");
    app_.footer(std::string(kTopFooter) + std::string(kExitStatus));
    app_.require_subcommand(0, 1);
    app_.get_formatter()->label("SUBCOMMAND", "VERB");
    app_.get_formatter()->label("Subcommands", "Verbs");
    app_.get_formatter()->label("Positionals", "Arguments");
    app_.get_formatter()->label("REQUIRED", "(required)");
    add_build();
    add_pile();
    add_tiles();
    add_render();
    add_inspect();
    add_completion();
    verb("man", "prints the manual page");
    add_help();
    verb("docs", "prints the reference of operations")->group("");
  }

  std::optional<Command> parse(std::span<const char* const> words) {
    try {
      app_.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::Success& success) {
      app_.exit(success, std::cout, std::cerr);
      return std::nullopt;
    } catch (const CLI::ExtrasError&) {
      refuse_rest();
    } catch (const CLI::ParseError& error) {
      std::string line = error.what();
      std::replace(line.begin(), line.end(), '\n', ' ');
      throw usage_error(fmt::format("{}; see '{} --help'", line, called()));
    }
    if (app_.get_subcommands().empty())
      throw usage_error("no verb given; talus --help lists them, 'talus build' makes a scene");
    command_.verb = app_.get_subcommands().front()->get_name();
    if (command_.verb == "help") return parse_help_about(command_.subject);
    return command_;
  }

  CommandLineHelp describe() const {
    CommandLineHelp help{app_.get_description(), app_.get_footer(), options_of(app_), {}};
    for (const CLI::App* sub : app_.get_subcommands([](const CLI::App*) { return true; }))
      if (!sub->get_group().empty())
        help.verbs.push_back(
            {sub->get_name(), sub->get_description(), sub->get_footer(), options_of(*sub)});
    return help;
  }

 private:
  CLI::App* verb(const std::string& name, const std::string& help) {
    CLI::App* sub = app_.add_subcommand(name, help);
    sub->set_help_flag("-h,--help", "print this help");
    return sub;
  }

  void add_build() {
    CLI::App* sub = verb("build", "makes everything a recipe asks for");
    add_subject(sub, "SCENE", "recipe to build; without it the built-in ravine");
    add_output(sub, "DIR", "folder for the results (default out/NAME of the recipe)", false);
    add_recipe_options(sub);
    sub->footer(
        "Writes scene.glb (and the other formats asked for), preview.png and report.json.\n\n"
        "Examples:\n"
        "  talus build\n"
        "  talus build garden.toml -o out/garden --seed 7\n"
        "  talus build garden.toml --set operation.0.stone_size=5% --set view.zoom=1.5");
  }

  void add_pile() {
    CLI::App* sub = verb("pile", "turns a mesh or a shape into a pile of stones");
    add_subject(sub, "SUPPORT",
                "mesh file (OBJ, PLY, STL, OFF, glTF), or a shape such as sphere:radius=2")
        ->required();
    add_output(sub, "DIR", "folder for the results", true);
    add_keys(sub, list_keys(PileParams{}), "operation.0.", "Pile");
    add_keys(sub, list_keys(ReadMeshParams{}), "operation.0.support.", "Mesh file");
    add_keys(sub, list_keys(TileParams{}), "operation.0.tiles.", "Stones");
    add_recipe_options(sub);
    sub->footer(
        "Writes scene.glb (and the other formats asked for), preview.png and report.json.\n"
        "Shapes: sphere, box, capsule, cylinder.\n\n"
        "Examples:\n"
        "  talus pile angel.ply -o out/angel --stone-size 3%\n"
        "  talus pile spot.obj -o out/spot --surface-only --instances nodes\n"
        "  talus pile 'capsule:to=[0,0,3],to_radius=0.1' -o out/cone --save-scene cone.toml");
  }

  void add_tiles() {
    CLI::App* sub = verb("tiles", "makes a set of rock tiles alone");
    add_output(sub, "FILE", "tile set file to write", true);
    add_keys(sub, list_keys(TileParams{}), "", "Stones");
    add_option(sub, "--seed", "N", "seed", "which of the possible tile sets this is (default 1)");
    add_common(sub);
    sub->footer(
        "Example:\n"
        "  talus tiles -o slabs.tiles -n 6 --axis-z 0.4 --frames bedded --weathering-depth 0.05");
  }

  void add_render() {
    CLI::App* sub = verb("render", "draws a picture, without a display");
    add_subject(sub, "SCENE", "recipe (.toml), folder with a scene.glb, mesh file, or tile set")
        ->required();
    add_output(sub, "PNG", "picture to write", true);
    add_keys(sub, list_keys(ViewParams{}), "view.", "View");
    add_option(sub, "--up", "x|y|z", "up", "axis of a mesh file that points up");
    sub->add_option(
           "--section", command_.section,
           "instead of a view, a level cut through the stones at this height (m; of a tile "
           "set: cells)")
        ->type_name("Z");
    add_settings(sub);
    add_cache(sub);
    add_common(sub);
    sub->footer(
        "Examples:\n"
        "  talus render out/ravine -o ravine.png\n"
        "  talus render garden.toml -o garden.png --azimuth-deg 120 --width 1920 --height 1080\n"
        "  talus render slabs.tiles -o slabs.png --section 0.5");
  }

  void add_inspect() {
    CLI::App* sub = verb("inspect", "tells what is in a file and whether it is sound");
    add_subject(sub, "FILE", "mesh, scene, tile set, or a folder of results")->required();
    add_common(sub);
    sub->footer("Example:\n  talus inspect out/ravine --json");
  }

  void add_completion() {
    CLI::App* sub = verb("completion", "prints a completion script for a shell");
    add_subject(sub, "SHELL", "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    sub->footer(
        "Example:\n  talus completion bash > ~/.local/share/bash-completion/completions/talus");
  }

  void add_help() {
    CLI::App* sub = verb("help", "prints help, about one verb if it is named");
    add_subject(sub, "VERB", "verb to tell about");
    sub->footer("Example:\n  talus help build");
  }

  // `talus help VERB` is `talus VERB --help`.
  std::optional<Command> parse_help_about(const std::string& name) const {
    const auto named = [&](const CLI::App* sub) { return sub->get_name() == name; };
    if (name.empty()) return CommandLine().parse(std::array{"talus", "--help"});
    if (app_.get_subcommands(named).empty()) refuse_verb(name);
    return CommandLine().parse(std::array{"talus", name.c_str(), "--help"});
  }

  CLI::Option* add_subject(CLI::App* sub, const std::string& name, const std::string& help) {
    return sub->add_option(name, command_.subject, help)->type_name("");
  }

  void add_output(CLI::App* sub, const std::string& value, const std::string& help, bool required) {
    sub->add_option("-o,--output", command_.output, help)->required(required)->type_name(value);
  }

  // An option whose value goes into the document.
  void add_option(CLI::App* sub, const std::string& names, const std::string& value,
                  const std::string& path, const std::string& help,
                  const std::string& group = "Options", ToToml to_toml = as_typed) {
    const std::string shown = names.substr(0, names.find(','));
    const auto store = [this, path, shown, to_toml](const std::string& text) {
      command_.options.push_back({path, to_toml(text), shown + " " + text});
    };
    sub->add_option_function<std::string>(names, store, help)->type_name(value)->group(group);
  }

  // An option for each key of a described struct.
  void add_keys(CLI::App* sub, const std::vector<KeyHelp>& keys, const std::string& prefix,
                const std::string& group) {
    for (const KeyHelp& key : keys) {
      const std::string flag = flag_name(key.path);
      const std::string path = prefix + key.path;
      if (key.type != "true or false") {
        add_option(sub, flag, value_name(key), path, help_text(key), group,
                   is_vector(key) ? list_text : as_typed);
      } else {
        // A switch says the opposite of the default: --surface-only, --no-ground.
        const bool on = key.default_value == "true";
        const std::string name = on ? "--no-" + flag.substr(2) : flag;
        sub->add_flag_callback(
               name,
               [this, path, name, on] {
                 command_.options.push_back({path, on ? "false" : "true", name});
               },
               on ? "do not " + key.help : key.help)
            ->group(group);
      }
    }
  }

  void add_recipe_options(CLI::App* sub) {
    add_option(sub, "--seed", "N", "seed", "which of the possible scenes this is (default 1)");
    add_settings(sub);
    add_option(sub, "--formats", "LIST", "output.formats",
               "files written, separated by commas: glb, usda, ply, obj, and the tables of stones "
               "points and csv (default glb)",
               "Options", name_list);
    add_option(sub, "--for", "blender|unreal|godot|houdini|isaac", "output.for",
               "the program that is to open the scene; decides formats and instances where they "
               "are not given");
    add_option(sub, "--instances", "gpu|nodes|flattened", "output.instances",
               "how scene.glb repeats a stone (default gpu)");
    sub->add_option("--save-scene", command_.save_scene, "write the recipe this stands for")
        ->type_name("FILE");
    sub->add_flag_callback(
        "--no-preview", [this] { command_.preview = false; }, "draw no picture");
    add_cache(sub);
    add_common(sub);
  }

  void add_settings(CLI::App* sub) {
    sub->add_option("--set", command_.settings,
                    "set a key of the recipe, such as operation.0.stone_size=5%; repeatable")
        ->type_name("PATH=VALUE")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }

  void add_cache(CLI::App* sub) {
    sub->add_flag_callback(
        "--no-cache", [this] { command_.cache = false; },
        "neither use nor keep results of earlier runs");
    sub->add_option_function<std::string>(
           "--memory-limit",
           [this](const std::string& text) { command_.memory_limit = memory_size(text); },
           "refuse a terrain that would take more, such as 2GB (default three quarters of the "
           "machine's)")
        ->type_name("SIZE");
  }

  void add_common(CLI::App* sub) {
    sub->add_option("--threads", command_.threads, "use at most this many threads")
        ->type_name("N")
        ->check(CLI::Range(1, 4096).description(""));
    sub->add_flag("--quiet", command_.quiet, "no progress and no summary");
    sub->add_flag("--json", command_.json, "the result as JSON on standard output");
  }

  std::string called() const {
    const auto subs = app_.get_subcommands();
    return subs.empty() ? "talus" : "talus " + subs.front()->get_name();
  }

  // The first argument that nothing took, with the nearest that would have been.
  [[noreturn]] void refuse_rest() {
    const auto subs = app_.get_subcommands();
    const CLI::App& app = subs.empty() ? app_ : *subs.front();
    const std::string word = app_.remaining(true).front();
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> names;
    if (name.starts_with("-")) {
      for (const CLI::Option* option : app.get_options())
        for (const std::string& long_name : option->get_lnames()) names.push_back("--" + long_name);
      throw usage_error(
          fmt::format("{}: unknown option \"{}\"; {}", called(), name, suggest(name, names)));
    }
    if (!subs.empty())
      throw usage_error(fmt::format("{}: one argument too many, \"{}\"; see '{} --help'", called(),
                                    word, called()));
    refuse_verb(word);
  }

  [[noreturn]] void refuse_verb(const std::string& word) const {
    std::vector<std::string> names;
    for (const VerbHelp& each : describe().verbs) names.push_back(each.name);
    throw usage_error(fmt::format("unknown verb \"{}\"; {}", word, suggest(word, names)));
  }

  static std::vector<OptionHelp> options_of(const CLI::App& app) {
    std::vector<OptionHelp> options;
    for (const CLI::Option* option : app.get_options()) {
      OptionHelp help{.help = option->get_description(), .positional = option->get_positional()};
      if (help.positional) help.names.push_back(option->get_name());
      for (const std::string& name : option->get_snames()) help.names.push_back("-" + name);
      for (const std::string& name : option->get_lnames()) help.names.push_back("--" + name);
      if (option->get_items_expected_max() > 0) help.value = option->get_type_name();
      if (help.value.find('|') != std::string::npos &&
          help.value == CLI::detail::to_lower(help.value))
        help.choices = CLI::detail::split(help.value, '|');
      options.push_back(std::move(help));
    }
    return options;
  }

  CLI::App app_;
  Command command_;
};

}  // namespace

std::optional<Command> parse_command_line(int argc, const char* const* argv) {
  return CommandLine().parse({argv, static_cast<std::size_t>(argc)});
}

CommandLineHelp describe_command_line() { return CommandLine().describe(); }

}  // namespace talus::cli
