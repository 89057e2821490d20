// Where in a recipe something went wrong, or went without effect, while it was built.
#include <gtest/gtest.h>

#include <algorithm>

#include "talus/scene/build.h"
#include "talus/scene/report.h"
#include "temporary_folder.h"

namespace talus {
namespace {

Recipe recipe_of(std::string_view text) {
  return read_recipe(parse_document(text, "scene.toml"), "folder");
}

struct Failure {
  ErrorKind kind = ErrorKind::job;
  std::string line;
};

Failure failure_of(const Recipe& recipe) {
  try {
    build(recipe);
  } catch (const Error& error) {
    return {error.kind(), error.what()};
  }
  return {};
}

// Level ground to work on, lines 1 to 7.
const std::string kGround = R"([terrain]
size = [10, 10]

[[operation]]
type = "noise_terrain"
relief = 0

)";

TEST(OperationPlace, BeginsWhatGoesWrongInABuild) {
  const Failure missing = failure_of(
      recipe_of(kGround + "[[operation]]\ntype = \"heightmap\"\nfile = \"mountan.tif\"\n"));
  EXPECT_EQ(missing.kind, ErrorKind::input);
  EXPECT_EQ(missing.line,
            "scene.toml:8: operation.heightmap: folder/mountan.tif: cannot read: no such file");

  const Failure empty =
      failure_of(recipe_of(kGround + "[[operation]]\ntype = \"pile\"\nsupport = \"rocks\"\n"));
  EXPECT_EQ(empty.kind, ErrorKind::usage);
  EXPECT_TRUE(empty.line.starts_with("scene.toml:8: operation.pile: the terrain has no layer of"))
      << empty.line;

  const Failure large = failure_of(recipe_of(
      "\n[[operation]]\ntype = \"pile\"\nsupport = { shape = \"sphere\" }\nstone_size = 9\n"));
  EXPECT_EQ(large.kind, ErrorKind::usage);
  EXPECT_TRUE(large.line.starts_with("scene.toml:2: operation.pile: stone_size")) << large.line;
}

TEST(OperationPlace, IsLeftOutWhereThereIsNone) {
  const Recipe recipe{.operations = {{HeightmapOperation{.file = "none.tif"}}}};
  EXPECT_EQ(failure_of(recipe).line, "none.tif: cannot read: no such file");
}

TEST(OperationPlace, TellsWhatIsWrongWithAStroke) {
  const auto line = [](const std::string& keys) {
    return failure_of(recipe_of(kGround + "[[operation]]\ntype = \"sculpt\"\n" + keys)).line;
  };
  EXPECT_EQ(line("points = [[5, 5], [50, 5]]\n"),
            "scene.toml:8: operation.sculpt.points: (50, 5) is outside the terrain, which "
            "reaches from (0, 0) to (10, 10)");
  EXPECT_THROW(recipe_of("[[operation]]\ntype = \"sculpt\"\npoints = [[5]]\n"), Error);
  EXPECT_THROW(recipe_of("[[operation]]\ntype = \"sculpt\"\npoints = [[nan, 5]]\n"), Error);
  EXPECT_THROW(recipe_of("[[operation]]\ntype = \"sculpt\"\n"), Error);
}

TEST(OperationPlace, SaysThatNumbersHaveNoUnit) {
  std::string line;
  try {
    recipe_of("[[operation]]\ntype = \"sculpt\"\npoints = [[5, 5]]\nradius = \"3cm\"\n");
  } catch (const Error& error) {
    line = error.what();
  }
  EXPECT_NE(line.find("operation.sculpt.radius: "), std::string::npos) << line;
  EXPECT_NE(line.find("a number without quotes and unit; lengths are in metres"), std::string::npos)
      << line;
}

TEST(OperationPlace, RefusesPlacesOutsideBeforeAnythingIsMade) {
  // The mesh is missing, which shows only once its operation runs.
  const std::string mesh = "[[operation]]\ntype = \"mesh_bedrock\"\nmesh = \"none.ply\"\n";
  const std::string tools[] = {
      "type = \"sculpt\"\n", "type = \"erode_surface\"\n", "type = \"deposit\"\nheight = 1\n",
      "type = \"sweep\"\nprofile = [[1, 0], [0, 1], [-1, 0]]\nnodes = [[50, 2], [50, 8]]\n"};
  for (const std::string& tool : tools) {
    const bool path = tool.find("nodes") != std::string::npos;
    const std::string line = failure_of(recipe_of(kGround + mesh + "[[operation]]\n" + tool +
                                                  (path ? "" : "points = [[5, 5], [50, 5]]\n")))
                                 .line;
    EXPECT_TRUE(line.starts_with("scene.toml:11: operation.")) << line;
    EXPECT_NE(line.find("outside the terrain, which reaches from (0, 0) to (10, 10)"),
              std::string::npos)
        << line;
  }
  // A path from outside in is none of them.
  EXPECT_TRUE(failure_of(recipe_of(kGround + mesh +
                                   "[[operation]]\ntype = \"sweep\"\nnodes = [[-5, 2], [50, 8]]\n"
                                   "profile = [[1, 0], [0, 1], [-1, 0]]\n"))
                  .line.starts_with("scene.toml:8: operation.mesh_bedrock: "));
}

TEST(OperationPlace, TellsWhatIsWrongWithASweep) {
  const auto line = [](const std::string& keys) {
    return failure_of(recipe_of(kGround + "[[operation]]\ntype = \"sweep\"\n" + keys)).line;
  };
  const auto refusal = [&](const std::string& keys) {
    try {
      return line(keys);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
  };
  const std::string profile = "profile = [[1, 0], [0, 1], [-1, 0]]\n";
  EXPECT_EQ(refusal(profile + "nodes = [[2, 2]]\n"),
            "scene.toml:8: operation.sweep.nodes: a path needs two nodes or more, not 1");
  EXPECT_EQ(refusal("nodes = [[2, 2], [4, 4]]\nprofile = [[0, 0], [4, 0], [0, 4], [4, 4]]\n"),
            "scene.toml:8: operation.sweep: node 0: a profile crosses itself near (2.396, "
            "1.683), between its points 1 and 3; give its points in order around it");
  EXPECT_EQ(refusal(profile + "nodes = [[2, 2], { scale = 2 }]\n"),
            "scene.toml:11: operation.sweep.nodes: \"at\" is missing; write at = [x, y] or "
            "[x, y, z]");
  EXPECT_EQ(refusal(profile + "nodes = [[2, 2], [4, 4]]\narcs = [[0, 1, 2]]\n"),
            "scene.toml:12: operation.sweep.arcs: an arc has 2 nodes, not 3: [from, to]");
  EXPECT_EQ(refusal(profile + "nodes = [[2, 2], [4, nan]]\n"),
            "scene.toml:11: operation.sweep.nodes: a coordinate must be a finite number");
  EXPECT_EQ(refusal(profile),
            "scene.toml:8: operation.sweep: \"nodes\" is missing; write nodes = [[X, Y, Z], "
            "[X, Y, Z], ...]");
  EXPECT_EQ(refusal(profile + "nodes = [[50, 2], [50, 8]]\n"),
            "scene.toml:8: operation.sweep.nodes: the path is outside the terrain, which "
            "reaches from (0, 0) to (10, 10)");
}

TEST(OperationPlace, TellsWhatIsWrongWithADepositOrErosion) {
  const auto line = [](const std::string& operation) {
    try {
      return failure_of(recipe_of(kGround + "[[operation]]\n" + operation)).line;
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  const std::string deposit = "type = \"deposit\"\n";
  EXPECT_EQ(line(deposit + "height = 1\n"),
            "scene.toml:8: operation.deposit: \"points\" is missing; write points = [[X, Y], [X, "
            "Y], ...], or mask = \"FILE\"");
  EXPECT_EQ(line(deposit + "points = [[5, 5]]\n"),
            "scene.toml:8: operation.deposit: how much is missing; write height = METRES or "
            "volume = CUBIC_METRES");
  EXPECT_EQ(line(deposit + "points = [[5, 5]]\nheight = 1\nvolume = 1\n"),
            "scene.toml:8: operation.deposit: \"height\" and \"volume\" are both given; leave one "
            "of them out");
  EXPECT_EQ(line(deposit + "points = [[5, 5]]\nheight = 1\nprofile = \"domes\"\n"),
            "scene.toml:12: operation.deposit.profile: unknown value \"domes\"; did you mean "
            "\"dome\"?");
  EXPECT_EQ(line(deposit + "points = [[5, 5]]\nheight = 1\nmaterial = \"air\"\n"),
            "scene.toml:8: operation.deposit: \"material\" is air; to take matter away, name it "
            "and write remove = true");
  EXPECT_EQ(line(deposit + "points = [[5, 5]]\nheight = 1\nprofile = \"map\"\n"),
            "scene.toml:8: operation.deposit: profile = \"map\" and map = \"FILE\" belong "
            "together; give both or none");
  EXPECT_EQ(line(deposit + "points = [[5, 50]]\nheight = 1\n"),
            "scene.toml:8: operation.deposit.points: (5, 50) is outside the terrain, which "
            "reaches from (0, 0) to (10, 10)");
  EXPECT_EQ(line("type = \"erode_surface\"\nmask = \"none.png\"\n"),
            "scene.toml:8: operation.erode_surface: folder/none.png: cannot read: no such file");
}

Check effect_of(const std::string& operation) {
  const Report report = make_report(build(recipe_of(kGround + "[[operation]]\n" + operation)));
  const auto check = std::find_if(report.checks.begin(), report.checks.end(),
                                  [](const Check& c) { return c.name == "operations_effective"; });
  return check == report.checks.end() ? Check{} : *check;
}

TEST(OperationPlace, TellsWhatChangedNothing) {
  const std::string_view idle[] = {
      // below the floor, beside the terrain, bedrock within bedrock, ground too low
      "type = \"primitive\"\nsupport = { shape = \"sphere\", center = [5, 5, -90] }\n",
      "type = \"primitive\"\nsupport = { shape = \"sphere\", center = [50, 5, 0] }\n",
      "type = \"primitive\"\nmaterial = \"bedrock\"\n"
      "support = { shape = \"sphere\", center = [5, 5, -0.5], radius = 0.4 }\n",
      "type = \"cover\"\nfrom_height = 100\n",
      "type = \"sculpt\"\npoints = [[5, 5]]\nheight = 0\n",
      "type = \"sweep\"\nprofile = [[1, 0], [0, 1], [-1, 0]]\nnodes = [[5, 1, 9], [5, 9, 9]]\n",
      "type = \"deposit\"\npoints = [[5, 5]]\nheight = 1\nremove = true\n",
      "type = \"erode_surface\"\npoints = [[5, 5, 9]]\n",
  };
  for (const std::string_view operation : idle) {
    const Check check = effect_of(std::string(operation));
    EXPECT_FALSE(check.ok) << operation;
    EXPECT_TRUE(check.detail.starts_with("scene.toml:8: operation.")) << check.detail;
    EXPECT_EQ(check.detail.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(effect_of("type = \"cover\"\n").ok);
  EXPECT_TRUE(effect_of("type = \"sculpt\"\npoints = [[3, 5], [6, 5, 0]]\n").ok);
  EXPECT_TRUE(effect_of("type = \"sweep\"\nprofile = [[1, 0], [0, 1], [-1, 0]]\n"
                        "nodes = [[5, 1], [5, 9]]\n")
                  .ok);
  EXPECT_TRUE(effect_of("type = \"primitive\"\nsupport = { shape = \"sphere\", center = [5, 5, 0] "
                        "}\n")
                  .ok);
}

TEST(OperationPlace, IsTheSameFromTheCache) {
  const TemporaryFolder cache;
  const Recipe recipe = recipe_of(kGround + "[[operation]]\ntype = \"cover\"\nfrom_height = 100\n");
  for (int run = 0; run < 2; ++run) {
    const BuildResult result = build(recipe, {.cache_folder = cache.path()});
    EXPECT_EQ(result.idle_operations, std::vector<std::string>{"scene.toml:8: operation.cover"});
    EXPECT_EQ(result.stages[1].cached, run == 1);
  }
}

}  // namespace
}  // namespace talus
