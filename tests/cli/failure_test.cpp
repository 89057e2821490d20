// What the tool does when something is wrong: one line, the right status, nothing half-written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "cli/program.h"
#include "test_data.h"

namespace talus {
namespace {

using Names = std::vector<std::string>;

void expect_refusal(const RunResult& result, int status, const std::string& part) {
  EXPECT_EQ(result.status, status) << result.error;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.error.starts_with("talus: error: ")) << result.error;
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
}

TEST(CliFailure, WrongCommandLinesAreUsageErrors) {
  const Workplace work;
  const std::vector<std::pair<Names, std::string>> cases = {
      {{}, "no verb given"},
      {{"biuld"}, "unknown verb \"biuld\"; did you mean \"build\"?"},
      {{"pile"}, "required"},
      {{"pile", "sphere"}, "--output is required"},
      {{"pile", "sphere", "-o", "out", "--stone-sise", "5%"},
       "talus pile: unknown option \"--stone-sise\"; did you mean \"--stone-size\"?"},
      {{"build", "a", "b"}, "talus build: one argument too many, \"b\""},
      {{"build", "--seed"}, "--seed"},
      {{"build", "--threads", "0"}, "--threads"},
      {{"build", "--threads", "many"}, "--threads"},
      {{"completion", "tcsh"}, "tcsh"},
      {{"pile", "sphere", "-o", "out", "--stone-size", "big"},
       "--stone-size big: operation.pile.stone_size: \"big\" is no length"},
      {{"pile", "sphere", "-o", "out", "-n", "4"},
       "-n 4: operation.pile.tiles.n = 4 cells is out of range; it must be from 5 to 16 cells"},
      {{"pile", "sphere", "-o", "out", "--seed", "-1"}, "--seed -1: seed: -1 is out of range"},
      {{"pile", "sphere:radius=0", "-o", "out"}, "operation.pile.support.radius = 0 m is out of"},
      {{"pile", "sphere:radius", "-o", "out"}, "cannot be read; write for example sphere:radius=2"},
      {{"pile", "sphere", "-o", "out", "--up", "z"}, "unknown key \"up\""},
      {{"pile", "sphere", "-o", "out", "--formats", "glb,fbx"}, "unknown value \"fbx\""},
      {{"pile", "sphere", "-o", "out", "--instances", "gpus"}, "did you mean \"gpu\"?"},
      {{"pile", "sphere", "-o", "out", "--for", "maya"},
       "--for maya: output.for: unknown value \"maya\"; there are blender, unreal, godot, houdini, "
       "isaac"},
      {{"build", "--set", "seed"}, "--set seed: write path=value"},
      {{"build", "--set", "operation.30.name=x"}, "operation has no element \"30\""},
      {{"tiles", "-o", "a.tiles", "--seeds-min", "3", "--seeds-max", "2"}, "seeds_min"},
      {{"render", "sphere.png", "-o", "a.png", "--zoom", "0"}, "--zoom 0: view.zoom = 0 is out of"},
      {{"render", "a.off", "-o", "a.png", "--eye", "1,2,3", "--target", "0,0,0", "--zoom", "2"},
       "--zoom 2: view.zoom: has no effect beside \"eye\"; leave one of them out"},
      {{"render", "a.off", "-o", "a.png", "--eye", "1,2"}, "--eye 1,2: view.eye: a list is wrong"},
      {{"render", "a.off", "-o", "a.png", "--camera", "low", "--set", "view.zoom=2"},
       "--set view.zoom=2: view.zoom: has no effect beside camera = \"low\""},
      {{"render", "a.off", "-o", "a.png", "--up", "w"}, "unknown value \"w\"; there are x, y, z"},
      {{"render", "a.off", "-o", "a.jpg"}, "a.jpg: pictures are written as PNG; name it a.png"},
      {{"build", "--memory-limit", "lots"},
       "--memory-limit lots: this is no size; write a whole number and B, KB, MB, GB or TB, each "
       "1000 times the one before, such as 2GB"},
      {{"build", "--memory-limit", "0"}, "--memory-limit 0: this is no size"},
      {{"pile", "shpere:radius=2", "-o", "out"},
       "no such file, and no shape \"shpere\"; did you mean \"sphere\"?"},
  };
  for (const auto& [words, part] : cases) expect_refusal(work.talus(words), 2, part);
  EXPECT_EQ(work.files(), Names{});
}

TEST(CliFailure, ABadRecipeIsNamedWithFileAndLine) {
  const Workplace work;
  work.write("bad.toml", kSmallRecipe + "stone_sise = 3\n");
  expect_refusal(work.talus({"build", "bad.toml"}), 2,
                 "bad.toml:7: operation.pile: unknown key \"stone_sise\"; did you mean "
                 "\"stone_size\"?");
  work.write("bad.toml", "seed = \n");
  expect_refusal(work.talus({"build", "bad.toml"}), 2, "bad.toml:1: ");
  EXPECT_EQ(work.files(), Names{"bad.toml"});
}

TEST(CliFailure, WhatABuildCannotDoIsNamedWithFileAndLine) {
  const Workplace work;
  work.write("scene.toml", "\n[[operation]]\ntype = \"heightmap\"\nfile = \"mountan.tif\"\n");
  expect_refusal(work.talus({"build", "scene.toml"}), 3,
                 "error: scene.toml:2: operation.heightmap: mountan.tif: cannot read: no such");
  EXPECT_EQ(work.files(), Names{"scene.toml"});
}

TEST(CliFailure, AnOperationWithoutEffectIsAWarning) {
  const Workplace work;
  work.write("scene.toml",
             "[terrain]\nsize = [10, 10]\n[[operation]]\ntype = \"primitive\"\n"
             "support = { shape = \"sphere\", center = [50, 5, 0] }\n");
  const RunResult result = work.talus({"build", "scene.toml", "--no-preview", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_TRUE(result.error.starts_with(
      "talus: warning: operations_effective: scene.toml:3: operation.primitive: nothing was"))
      << result.error;
}

TEST(CliFailure, StonesLargerThanTheSupportAreAUsageError) {
  const Workplace work;
  expect_refusal(work.talus({"pile", "sphere", "-o", "out", "--voxels", "20", "--stone-size", "9"}),
                 2, "stone_size");
  EXPECT_EQ(work.files(), Names{});
}

TEST(CliFailure, MissingFilesAreInputErrors) {
  const Workplace work;
  expect_refusal(work.talus({"build", "none.toml"}), 3, "none.toml");
  expect_refusal(work.talus({"pile", "none.ply", "-o", "out"}), 3, "none.ply");
  expect_refusal(work.talus({"inspect", "none.glb"}), 3, "none.glb");
  expect_refusal(work.talus({"render", "none.glb", "-o", "a.png"}), 3, "none.glb");
  expect_refusal(work.talus({"render", "none.toml", "-o", "a.png"}), 3, "none.toml");
  expect_refusal(work.talus({"inspect", "."}), 3, "scene.glb");
  EXPECT_EQ(work.files(), Names{});
  work.write("scene.toml", kSmallRecipe);
  expect_refusal(work.talus({"inspect", "scene.toml"}), 3, "`talus build scene.toml -o DIR`");
}

TEST(CliFailure, MalformedMeshesAreInputErrors) {
  const std::filesystem::path folder = std::filesystem::path(TALUS_TEST_DATA_DIR) / "malformed";
  NEEDS_TEST_DATA();
  const Workplace work;
  for (const char* name :
       {"obj/empty.obj", "obj/point_cloud.obj", "ply/crash-30d6d0f7.ply", "ply/empty.ply",
        "off/invalid.off", "off/OutOfMemory.off", "gltf/zero-sized-bin-chunk-issue-440.glb"}) {
    const RunResult result =
        work.talus({"pile", (folder / name).string(), "-o", "out", "--voxels", "20"});
    expect_refusal(result, 3, std::filesystem::path(name).filename().string());
  }
  EXPECT_EQ(work.files(), Names{});
}

TEST(CliFailure, UnwritableOutputIsFoundBeforeTheWork) {
  const Workplace work;
  work.write("file", "kept");
  const std::vector<Names> cases = {
      {"build", "-o", "file"},
      {"build", "-o", "file/below"},
      {"build", "-o", "/proc/none"},
      {"pile", "sphere", "-o", "file"},
      {"tiles", "-o", "missing/a.tiles"},
      {"render", "none.glb", "-o", "missing/a.png"},
      {"tiles", "-o", std::string(300, 'x')},
      {"pile", "sphere", "-o", "out", "--save-scene", "missing/a.toml"},
  };
  for (const Names& words : cases)
    expect_refusal(work.talus(words), 1, words.back().substr(0, words.back().find('/', 1)));
  EXPECT_FALSE(work.has("cache")) << "tiles were made";
  EXPECT_EQ(work.files(), Names{"file"});
  EXPECT_EQ(work.read("file"), "kept");
}

TEST(CliFailure, AFolderThatTakesNoFilesIsRefused) {
  const Workplace work;
  // Not even root may make files there, whom permissions do not bind.
  ASSERT_TRUE(std::filesystem::exists("/proc/self"));
  expect_refusal(work.talus({"build", "-o", "/proc"}), 1, "/proc: no file can be made there");
  EXPECT_EQ(work.files(), Names{});
}

TEST(CliFailure, AFullDiskLeavesTheOldFiles) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  std::filesystem::create_directory(work.path("out"));
  work.write("out/scene.glb", "old");
  // Files may grow to 64 KiB only, as on a disk that fills up.
  const RunParams full = {.prepare = [] {
    const rlimit limit{65536, 65536};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
  }};
  expect_refusal(
      work.talus({"build", "small.toml", "-o", "out", "--no-cache", "--no-preview"}, full), 1,
      "scene.glb");
  EXPECT_EQ(work.files(), (Names{"out", "out/scene.glb", "small.toml"}));
  EXPECT_EQ(work.read("out/scene.glb"), "old");
}

TEST(CliFailure, AFullCacheIsOnlyAWarning) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  work.write("cache", "a file where a folder should be");
  const RunResult result = work.talus({"build", "small.toml", "-o", "out", "--no-preview"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.error.starts_with("talus: warning: ")) << result.error;
}

TEST(CliFailure, AClosedStandardOutputIsAnError) {
  const Workplace work;
  const RunResult result =
      work.talus({"man"}, {.prepare = [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); }});
  expect_refusal(result, 1, "standard output");
}

TEST(CliFailure, AnUnwritableStandardErrorChangesNoStatus) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  work.write("cache", "a file where a folder should be");  // worth a warning
  const std::function<void()> closed = [] { close(STDERR_FILENO); };
  const std::function<void()> full = [] { dup2(open("/dev/full", O_WRONLY), STDERR_FILENO); };
  for (const auto& prepare : {closed, full}) {
    const RunParams silent = {.prepare = prepare};
    EXPECT_EQ(work.talus({"biuld"}, silent).status, 2);
    EXPECT_EQ(work.talus({"inspect", "none.glb"}, silent).status, 3);
    EXPECT_EQ(work.talus({"build", "small.toml", "-o", "out", "--no-preview"}, silent).status, 0);
  }
}

TEST(CliFailure, NoFileTakesThePlaceOfAClosedStream) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult whole = work.talus({"build", "small.toml", "-o", "a", "--no-preview"});
  ASSERT_EQ(whole.status, 0) << whole.error;
  const RunResult closed =
      work.talus({"build", "small.toml", "-o", "b", "--no-preview"}, {.prepare = [] {
                   for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
                     close(stream);
                 }});
  EXPECT_EQ(closed.status, 1) << "the summary cannot be written";
  EXPECT_EQ(work.read("b/scene.glb"), work.read("a/scene.glb"));
}

TEST(CliFailure, ANameTooLongIsAnInputError) {
  const Workplace work;
  const std::string name(300, 'x');
  const std::vector<Names> cases = {{"inspect", name},
                                    {"render", name, "-o", "a.png"},
                                    {"render", name + ".toml", "-o", "a.png"},
                                    {"build", name + ".toml"},
                                    {"pile", name + ".obj", "-o", "out"}};
  for (const Names& words : cases) expect_refusal(work.talus(words), 3, "File name too long");
  EXPECT_EQ(work.files(), Names{});
}

// Returns when the output folder is there: the work has begun.
void wait_for_start(const Workplace& work) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!work.has("out") && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(CliFailure, CtrlCCancelsAndLeavesNothing) {
  const Workplace work;
  for (const int signal : {SIGINT, SIGTERM}) {
    const RunResult result = work.talus({"pile", "sphere", "-o", "out", "-n", "8", "--set",
                                         "operation.0.tiles.voxels_per_edge=160"},
                                        {.meanwhile = [&](pid_t child) {
                                          wait_for_start(work);
                                          kill(child, signal);
                                        }});
    expect_refusal(result, 1, "cancelled");
    EXPECT_EQ(work.files(), Names{});
  }
}

TEST(CliFailure, ASecondCtrlCEndsAtOnce) {
  const Workplace work;
  const RunResult result = work.talus(
      {"pile", "sphere", "-o", "out", "-n", "8", "--set", "operation.0.tiles.voxels_per_edge=160"},
      {.meanwhile = [&](pid_t child) {
        wait_for_start(work);
        // Sent together, the two would be one.
        kill(child, SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        kill(child, SIGINT);
      }});
  // The job may already have seen the first.
  EXPECT_TRUE(result.status == 128 + SIGINT || result.status == 1) << result.status;
}

}  // namespace
}  // namespace talus
