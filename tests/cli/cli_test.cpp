// What the verbs do when all is well.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "test_data.h"

namespace talus {
namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

TEST(Cli, BuildWritesSceneReportAndNothingElse) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult result = work.talus({"build", "small.toml", "--no-preview"});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(work.files(), (Names{"out", "out/small", "out/small/report.json", "out/small/scene.glb",
                                 "small.toml"}));
  EXPECT_NE(result.out.find("out/small/scene.glb"), std::string::npos);
}

TEST(Cli, BuildDrawsAPreview) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult result = work.talus(
      {"build", "small.toml", "-o", "out", "--set", "view.width=64", "--set", "view.height=48"});
  EXPECT_EQ(result.status, 0) << result.error;
  ASSERT_TRUE(work.has("out/preview.png")) << result.error;
  EXPECT_TRUE(work.read("out/preview.png").starts_with("\x89PNG"));
}

TEST(Cli, NoPreviewOfAnotherSceneStays) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  std::filesystem::create_directory(work.path("out"));
  work.write("out/preview.png", "of an older scene");
  const RunResult result = work.talus({"build", "small.toml", "-o", "out", "--no-preview"});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_FALSE(work.has("out/preview.png"));
}

TEST(Cli, JsonIsTheReport) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult result =
      work.talus({"build", "small.toml", "-o", "out", "--no-preview", "--json"});
  ASSERT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(Json::parse(result.out), Json::parse(work.read("out/report.json")));
  EXPECT_EQ(Json::parse(result.out)["seed"], 5);
}

TEST(Cli, QuietSaysNothing) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult result =
      work.talus({"build", "small.toml", "-o", "out", "--no-preview", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.error, "");
}

TEST(Cli, HashDoesNotDependOnThreadsOrCache) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const auto report = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"build", "small.toml", "-o", "out", "--no-preview", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return Json::parse(work.talus(words).out);
  };
  const Json one = report({"--threads", "1", "--no-cache"});
  const Json two = report({"--threads", "2", "--no-cache"});
  EXPECT_EQ(one["threads"], 1);
  EXPECT_EQ(two["threads"], 2);
  EXPECT_EQ(one["hash"], two["hash"]);
  EXPECT_FALSE(work.has("cache"));
  const Json kept = report({});
  EXPECT_TRUE(work.has("cache"));
  EXPECT_EQ(kept["stages"][0]["cached"], false);
  EXPECT_EQ(report({})["stages"][0]["cached"], true);
  EXPECT_NE(report({"--seed", "6"})["hash"], one["hash"]);
}

TEST(Cli, SettingsAndOptionsReachTheRecipe) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const RunResult result =
      work.talus({"build", "small.toml", "-o", "out", "--no-preview", "--seed", "9", "--set",
                  "operation.0.name=heap", "--formats", "glb,ply", "--instances", "nodes",
                  "--save-scene", "saved.toml"});
  ASSERT_EQ(result.status, 0) << result.error;
  EXPECT_TRUE(work.has("out/scene.ply"));
  const std::string saved = work.read("saved.toml");
  EXPECT_NE(saved.find("seed = 9"), std::string::npos) << saved;
  EXPECT_NE(saved.find("name = \"heap\""), std::string::npos) << saved;
  EXPECT_NE(saved.find("instances = \"nodes\""), std::string::npos) << saved;
}

TEST(Cli, ASavedSceneIsTheSameScene) {
  const Workplace work;
  const Json first =
      Json::parse(work.talus({"pile", "cylinder:height=3,radius=1", "-o", "out", "--voxels", "20",
                              "--stone-size", "15%", "--axis-z", "[0.5,0.8]", "--no-preview",
                              "--json", "--save-scene", "saved.toml"})
                      .out);
  const Json second =
      Json::parse(work.talus({"build", "saved.toml", "-o", "out2", "--no-preview", "--json"}).out);
  EXPECT_EQ(first["hash"], second["hash"]);
  EXPECT_EQ(second["stages"][1]["cached"], true);
}

TEST(Cli, PileReadsAMesh) {
  const std::string spot = std::string(TALUS_TEST_DATA_DIR) + "/mesh/spot.obj";
  NEEDS_TEST_DATA();
  const Workplace work;
  const RunResult result =
      work.talus({"pile", spot, "-o", "out", "--voxels", "20", "--no-preview", "--json"});
  ASSERT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(result.error, "");
  EXPECT_GT(Json::parse(result.out)["stones"]["instances"], 500);

  // Lying on its side, the cow is another scene.
  const RunResult lying = work.talus(
      {"pile", spot, "-o", "out", "--voxels", "20", "--no-preview", "--json", "--up", "z"});
  EXPECT_NE(Json::parse(lying.out)["hash"], Json::parse(result.out)["hash"]);
}

TEST(Cli, TilesWritesATileSet) {
  const Workplace work;
  const RunResult result = work.talus(
      {"tiles", "-o", "slabs.tiles", "-n", "5", "--voxels", "30", "--axis-z", "0.4", "--json"});
  ASSERT_EQ(result.status, 0) << result.error;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["tiles"]["n"], 5);
  EXPECT_EQ(json["tiles"]["voxels_per_edge"], 30);

  const RunResult again =
      work.talus({"tiles", "-o", "slabs.tiles", "-n", "5", "--voxels", "30", "--axis-z", "0.4"});
  EXPECT_NE(
      again.out.find(fmt::format("\nslabs.tiles, {:.1f} MB\n",
                                 1e-6 * static_cast<double>(work.read("slabs.tiles").size()))),
      std::string::npos)
      << again.out;

  const RunResult found = work.talus({"inspect", "slabs.tiles", "--json"});
  ASSERT_EQ(found.status, 0) << found.error;
  EXPECT_EQ(Json::parse(found.out)["tiles"], json["tiles"]);
}

TEST(Cli, RenderDrawsATileSetAndACutThroughIt) {
  const Workplace work;
  ASSERT_EQ(work.talus({"tiles", "-o", "a.tiles", "--voxels", "20", "--quiet"}).status, 0);
  const RunResult plate =
      work.talus({"render", "a.tiles", "-o", "a.png", "--width", "64", "--height", "36", "--json"});
  ASSERT_EQ(plate.status, 0) << plate.error;
  EXPECT_EQ(Json::parse(plate.out)["height"], 36);

  std::vector<std::string> cuts;
  for (const char* height : {"0.5", "2.5"}) {
    const RunResult cut = work.talus(
        {"render", "a.tiles", "-o", "cut.png", "--section", height, "--width", "200", "--json"});
    ASSERT_EQ(cut.status, 0) << cut.error;
    EXPECT_EQ(Json::parse(cut.out)["height"], 200) << "as high as wide";
    cuts.push_back(work.read("cut.png"));
  }
  EXPECT_NE(cuts[0], cuts[1]);

  for (const char* height : {"-1", "9", "1e9", "nan"}) {
    const RunResult refused =
        work.talus({"render", "a.tiles", "-o", "none.png", "--section", height});
    EXPECT_EQ(refused.status, 2) << height;
    EXPECT_NE(refused.error.find("the stones lie from 0 to 8 cells"), std::string::npos)
        << refused.error;
  }
}

TEST(Cli, RenderCutsThroughTheStonesOfAScene) {
  const Workplace work;
  ASSERT_EQ(work.talus({"pile", "box:size=[4,2,2]", "-o", "out", "--stone-size", "0.5", "--voxels",
                        "20", "--no-preview", "--quiet"})
                .status,
            0);
  for (const char* subject : {"out", "out/scene.glb"}) {
    const RunResult cut = work.talus(
        {"render", subject, "-o", "cut.png", "--section", "0", "--width", "200", "--json"});
    ASSERT_EQ(cut.status, 0) << cut.error;
    EXPECT_NEAR(Json::parse(cut.out)["height"].get<double>(), 100, 25);
  }
}

TEST(Cli, TilesComeInThreeVarieties) {
  const Workplace work;
  const std::pair<const char*, int> varieties[] = {
      {"aperiodic", 7382}, {"columns", 680}, {"periodic", 64}};
  for (const auto& [variety, stones] : varieties) {
    const RunResult made =
        work.talus({"tiles", "-o", "a.tiles", "--variety", variety, "--voxels", "20", "--json"});
    ASSERT_EQ(made.status, 0) << made.error;
    EXPECT_EQ(Json::parse(made.out)["tiles"]["variety"], variety);
    EXPECT_EQ(Json::parse(made.out)["tiles"]["unique"], stones);
    const RunResult found = work.talus({"inspect", "a.tiles", "--json"});
    EXPECT_EQ(Json::parse(found.out)["tiles"]["variety"], variety);
  }
  const RunResult wrong = work.talus({"tiles", "-o", "a.tiles", "--variety", "column"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.error.find("did you mean \"columns\"?"), std::string::npos) << wrong.error;
}

TEST(Cli, TilesThatDeviateMuchAreToldWhichNWouldDo) {
  const Workplace work;
  const RunResult much =
      work.talus({"tiles", "-o", "a.tiles", "--variety", "columns", "--axis-z", "0.2", "--json"});
  ASSERT_EQ(much.status, 0) << much.error;
  EXPECT_GT(Json::parse(much.out)["tiles"]["deviation_bound_percent"], 5);
  EXPECT_NE(much.error.find("n = 7 leaves less than 5 %"), std::string::npos) << much.error;
  const RunResult little = work.talus({"tiles", "-o", "a.tiles", "--variety", "columns"});
  EXPECT_EQ(little.error, "");
}

TEST(Cli, InspectCountsWhatBuildWrote) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const Json built =
      Json::parse(work.talus({"build", "small.toml", "-o", "out", "--no-preview", "--json"}).out);
  const RunResult found = work.talus({"inspect", "out", "--json"});
  ASSERT_EQ(found.status, 0) << found.error;
  const Json json = Json::parse(found.out);
  EXPECT_EQ(json["parts"]["stones"]["instances"], built["stones"]["instances"]);
  EXPECT_EQ(json["instancing"]["sound"], true);
  EXPECT_NE(work.talus({"inspect", "out"}).out.find("sound: instancing"), std::string::npos);
}

TEST(Cli, BuildAndInspectTellMeshesAlike) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const std::string built = work.talus({"build", "small.toml", "-o", "out", "--no-preview"}).out;
  const std::string found = work.talus({"inspect", "out"}).out;
  const auto between = [](const std::string& text, std::string_view from, std::string_view to) {
    const std::size_t begin = text.find(from);
    return begin == std::string::npos
               ? "nothing"
               : text.substr(begin + from.size(), text.find(to, begin) - begin - from.size());
  };
  EXPECT_EQ(between(built, "stones of ", ","), between(found, "instances of ", ","));
}

TEST(Cli, BuildTellsWhatCameFromTheCache) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  const Names words = {"build", "small.toml", "-o", "out", "--no-preview"};
  EXPECT_EQ(work.talus(words).out.find("from the cache"), std::string::npos);
  EXPECT_NE(work.talus(words).out.find("2 of 3 steps from the cache\n"), std::string::npos);
}

TEST(Cli, InspectTakesWhateverFormatAFolderHolds) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe +
                               "[[operation]]\ntype = \"noise_terrain\"\n[terrain]\nsize = [8, 6]\n"
                               "[output]\nformats = [\"ply\"]\n");
  ASSERT_EQ(work.talus({"build", "small.toml", "-o", "out", "--no-preview"}).status, 0);
  const RunResult found = work.talus({"inspect", "out"});
  EXPECT_TRUE(found.out.starts_with("out/scene.ply: ")) << found.error;
  EXPECT_NE(found.out.find("  bedrock in the columns: "), std::string::npos) << found.out;
}

TEST(Cli, ABrushBetweenTheMiddlesOfColumnsIsTold) {
  const Workplace work;
  work.write("scene.toml",
             "[terrain]\nsize = [10, 10]\n[[operation]]\ntype = \"deposit\"\nvolume = 1\n"
             "points = [[5, 5]]\nradius = 0.1\n");
  const RunResult result = work.talus({"build", "scene.toml", "--no-preview", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.error.find("a brush of radius 0.1 m may lie between the columns' middles, from "
                              "0.3536 m on it always meets one"),
            std::string::npos)
      << result.error;
}

TEST(Cli, InspectTellsOpenFromUnsound) {
  const Workplace work;
  work.write("open.toml",
             kSmallRecipe +
                 "[[operation]]\ntype = \"noise_terrain\"\nrelief = 0\n[terrain]\nsize = [8, 6]\n"
                 "[ground]\nskirt = 0\n[output]\nformats = [\"glb\", \"obj\"]\n");
  ASSERT_EQ(work.talus({"build", "open.toml", "-o", "out", "--no-preview"}).status, 0);
  for (const char* name : {"out", "out/scene.obj"}) {
    const std::string text = work.talus({"inspect", name}).out;
    EXPECT_NE(text.find("triangles drawn\nopen: 56 border edges, manifold, oriented\nstones: "),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("not sound"), std::string::npos) << text;
    EXPECT_EQ(text.find("encloses"), std::string::npos) << text;
  }
  work.write("twisted.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 2 3\n");
  EXPECT_NE(work.talus({"inspect", "twisted.off"}).out.find("not sound: 4 border edges, 1 edges"),
            std::string::npos);
}

TEST(Cli, RenderDrawsRecipesFoldersAndMeshes) {
  const Workplace work;
  work.write("small.toml", kSmallRecipe);
  work.write("tetra.off",
             "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
             "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  ASSERT_EQ(work.talus({"build", "small.toml", "-o", "out", "--no-preview"}).status, 0);
  for (const char* subject : {"small.toml", "out", "tetra.off"}) {
    const RunResult result = work.talus({"render", subject, "-o", "picture.png", "--width", "64",
                                         "--height", "48", "--azimuth-deg", "-30", "--quiet"});
    ASSERT_EQ(result.status, 0) << subject << ": " << result.error;
    EXPECT_TRUE(work.read("picture.png").starts_with("\x89PNG")) << subject;
    std::filesystem::remove(work.path("picture.png"));
  }
}

TEST(Cli, TheBuiltInSceneIsARavineWithFallenStones) {
  const Workplace work;
  const RunResult result = work.talus({"build", "--no-preview", "--json", "--set", "terrain.cell=1",
                                       "--set", "operation.7.tiles.voxels_per_edge=20"});
  ASSERT_EQ(result.status, 0) << result.error;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report["terrain"]["columns"], 110 * 90);
  EXPECT_GT(report["stones"]["instances"], 100);
  EXPECT_TRUE(report["meshes"]["ground"]["closed"]);
  EXPECT_TRUE(work.has("out/ravine/scene.glb"));

  const RunResult inspected = work.talus({"inspect", "out/ravine"});
  EXPECT_NE(inspected.out.find("terrain: 9900 columns"), std::string::npos) << inspected.out;
  EXPECT_NE(inspected.out.find("operations balance"), std::string::npos) << inspected.out;
}

TEST(Cli, MemoryLimitRefusesBeforeAnythingIsMade) {
  const Workplace work;
  const RunResult result = work.talus({"build", "--memory-limit", "10MB", "-o", "out"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.error.find("but only 10 MB may be used"), std::string::npos) << result.error;
  EXPECT_FALSE(work.has("out"));
}

}  // namespace
}  // namespace talus
