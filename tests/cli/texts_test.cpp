// Texts that the tool makes from its own description.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace talus {
namespace {

const std::vector<std::string> kVerbs = {"build",   "pile",       "tiles", "render",
                                         "inspect", "completion", "man"};

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

TEST(CliTexts, TheReferenceInDocsIsUpToDate) {
  const RunResult made = Workplace().talus({"docs"});
  ASSERT_EQ(made.status, 0);
  const RunResult kept =
      run_program({"cat", std::string(TALUS_SOURCE_DIR) + "/docs/operations.md"});
  EXPECT_EQ(made.out, kept.out) << "make it again: talus docs > docs/operations.md";
}

}  // namespace
}  // namespace talus
