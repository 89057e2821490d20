// Texts that the tool makes from its own description.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "talus/scene/recipe.h"

namespace talus {
namespace {

const std::vector<std::string> kVerbs = {"build",   "pile",       "tiles", "render",
                                         "inspect", "completion", "man",   "help"};

TEST(CliTexts, HelpNamesEveryVerbAndTheExitStatuses) {
  const Workplace work;
  const RunResult help = work.talus({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.error, "");
  for (const std::string& verb : kVerbs)
    EXPECT_NE(help.out.find("  " + verb + " "), std::string::npos) << verb;
  EXPECT_NE(help.out.find("Exit status: 0 done"), std::string::npos);
  for (const std::string& verb : kVerbs) {
    const RunResult own = work.talus({verb, "--help"});
    EXPECT_EQ(own.status, 0);
    EXPECT_NE(own.out.find("Usage: talus " + verb), std::string::npos) << own.out;
  }
}

TEST(CliTexts, HelpIsAVerbToo) {
  const Workplace work;
  EXPECT_EQ(work.talus({"help"}).out, work.talus({"--help"}).out);
  EXPECT_EQ(work.talus({"help", "pile"}).out, work.talus({"pile", "--help"}).out);
  EXPECT_EQ(work.talus({"help", "pile"}).status, 0);
  const RunResult unknown = work.talus({"help", "plie"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.error, "talus: error: unknown verb \"plie\"; did you mean \"pile\"?\n");
}

TEST(CliTexts, VersionIsOneLine) {
  const RunResult result = Workplace().talus({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.out.starts_with("talus ")) << result.out;
  EXPECT_EQ(result.out.find('\n'), result.out.size() - 1);
}

TEST(CliTexts, OptionsAreMadeFromTheDescribedParameters) {
  const std::string help = Workplace().talus({"pile", "--help"}).out;
  for (const char* option : {"--stone-size", "--inside-fraction", "--surface-only", "--seeds-max",
                             "--contacts-radius", "--weathering-depth", "--up", "--scale"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
}

TEST(CliTexts, BashCompletionIsValidAndCompletes) {
  const Workplace work;
  work.write("talus.bash", work.talus({"completion", "bash"}).out);
  const RunResult checked = run_program({"bash", "-n", work.path("talus.bash")});
  EXPECT_EQ(checked.status, 0) << checked.error;

  const auto complete = [&](const std::string& words, int index) {
    return run_program({"bash", "-c",
                        "source " + work.path("talus.bash") + "; COMP_WORDS=(" + words +
                            "); COMP_CWORD=" + std::to_string(index) +
                            "; _talus; echo \"${COMPREPLY[@]}\""})
        .out;
  };
  EXPECT_EQ(complete("talus b", 1), "build\n");
  EXPECT_EQ(complete("talus pile --stone", 2), "--stone-size\n");
  EXPECT_EQ(complete("talus build --instances n", 3), "nodes\n");
  EXPECT_EQ(complete("talus completion z", 2), "zsh\n");
}

TEST(CliTexts, OtherShellsGetEveryVerb) {
  const Workplace work;
  for (const char* shell : {"zsh", "fish"}) {
    const RunResult script = work.talus({"completion", shell});
    EXPECT_EQ(script.status, 0);
    for (const std::string& verb : kVerbs)
      EXPECT_NE(script.out.find(verb), std::string::npos) << shell << " " << verb;
    if (run_program({shell, "-c", "true"}).status != 0) continue;
    work.write("script", script.out);
    const RunResult checked = run_program({shell, "-n", work.path("script")});
    EXPECT_EQ(checked.status, 0) << shell << ": " << checked.error;
  }
}

TEST(CliTexts, ManualPageIsSoundRoff) {
  const Workplace work;
  const RunResult page = work.talus({"man"});
  ASSERT_EQ(page.status, 0);
  for (const std::string& verb : kVerbs)
    EXPECT_NE(page.out.find(".SS " + verb), std::string::npos) << verb;
  work.write("talus.1", page.out);
  const RunResult shown =
      run_program({"groff", "-man", "-Tutf8", "-ww", "-z", work.path("talus.1")});
  EXPECT_EQ(shown.status, 0) << "groff, which the test set-up installs";
  EXPECT_EQ(shown.error, "");
}

// The part of a page below a heading, to the next heading of that rank.
std::string section(const std::string& page, std::string_view heading) {
  const std::size_t begin = page.find(fmt::format("\n## `{}`\n", heading));
  if (begin == std::string::npos) return "";
  return page.substr(begin, page.find("\n## ", begin + 1) - begin);
}

bool has_key(const std::string& text, std::string_view key) {
  return text.find(fmt::format("\n| `{}` |", key)) != std::string::npos;
}

TEST(CliTexts, TheReferenceHasEveryTableAndKeyOfARecipe) {
  const std::string page = Workplace().talus({"docs"}).out;
  std::size_t in_tables = 0;
  for (const KeyHelp& key : list_keys(Recipe{})) {
    const std::size_t dot = key.path.find('.');
    if (dot != std::string::npos) {
      const std::string table = fmt::format("[{}]", key.path.substr(0, dot));
      EXPECT_TRUE(has_key(section(page, table), key.path.substr(dot + 1))) << key.path;
      ++in_tables;
    } else if (key.path != "operation") {
      EXPECT_TRUE(has_key(page, key.path)) << key.path;
    }
  }
  EXPECT_GT(in_tables, 20u);
  EXPECT_TRUE(has_key(page, "[[operation]]"));
  for (const OperationType& type : operation_types())
    for (const KeyHelp& key : list_keys(type))
      EXPECT_TRUE(has_key(section(page, type.name), key.path)) << type.name << " " << key.path;
}

TEST(CliTexts, TheReferenceInDocsIsUpToDate) {
  const RunResult made = Workplace().talus({"docs"});
  ASSERT_EQ(made.status, 0);
  const RunResult kept =
      run_program({"cat", std::string(TALUS_SOURCE_DIR) + "/docs/operations.md"});
  EXPECT_EQ(made.out, kept.out) << "make it again: talus docs > docs/operations.md";
}

}  // namespace
}  // namespace talus
