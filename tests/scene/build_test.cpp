#include "talus/scene/build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "talus/base/parallel.h"
#include "talus/io/png.h"
#include "talus/io/read_file.h"
#include "talus/piles/pile_check.h"
#include "talus/piles/pile_edits.h"
#include "talus/scene/outputs.h"
#include "talus/scene/report.h"
#include "temporary_folder.h"
#include "test_data.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

// Coarse tiles in a small shape: everything in a fraction of a second.
constexpr std::string_view kSmall = R"(
seed = 5
[[operation]]
type = "pile"
name = "heap"
support = { shape = "sphere", radius = 2 }
stone_size = "20%"
tiles = { n = 5, voxels_per_edge = 20 }
)";

Recipe small_recipe() { return read_recipe(parse_document(kSmall, "small.toml")); }

BuildParams kept_in(const fs::path& folder) { return {.cache_folder = folder}; }

std::vector<bool> cached_stages(const BuildResult& result) {
  std::vector<bool> cached;
  for (const Stage& stage : result.stages) cached.push_back(stage.cached);
  return cached;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Build, MakesThePileOfTheRecipe) {
  const BuildResult result = build(small_recipe());
  ASSERT_EQ(result.piles.size(), 1u);
  EXPECT_EQ(result.piles[0].name, "heap");
  EXPECT_EQ(result.stones.instances.size(), result.piles[0].pile.stats.instances);
  // A ball of radius 2 has 33.5 m^3; a cell 0.8^3, one stone each.
  EXPECT_NEAR(static_cast<double>(result.stones.instances.size()), 33.5 / 0.512, 15);
  EXPECT_NEAR(*result.plane, -2 + 0.25 * 0.8, 1e-9);
  EXPECT_EQ(cached_stages(result), (std::vector<bool>{false, false, false}));
}

TEST(Build, JoinsThePilesOfAllOperations) {
  Recipe recipe = small_recipe();
  recipe.operations.push_back(recipe.operations[0]);
  auto& second = std::get<PileOperation>(recipe.operations[1].params);
  second.support = Shape(Sphere{.center = Vec3(9, 0, 0), .radius = 2});
  const BuildResult result = build(recipe);
  EXPECT_EQ(result.tile_sets.size(), 1u) << "equal tiles are made once";
  ASSERT_EQ(result.piles.size(), 2u);
  EXPECT_EQ(result.stones.instances.size(),
            result.piles[0].pile.stats.instances + result.piles[1].pile.stats.instances);
  // Runs of one prototype stay contiguous, every prototype is used.
  EXPECT_TRUE(std::is_sorted(
      result.stones.instances.begin(), result.stones.instances.end(),
      [](const Instance& a, const Instance& b) { return a.prototype < b.prototype; }));
  EXPECT_EQ(result.stones.instances.back().prototype + 1, result.stones.prototypes.size());
  EXPECT_GT(bounds(result.stones).max.x, 10);
  // A mesh that both piles use is one prototype.
  std::set<const TriangleMesh*> meshes;
  for (const auto& mesh : result.stones.prototypes) EXPECT_TRUE(meshes.insert(mesh.get()).second);
  EXPECT_LT(meshes.size(), instances(result.piles[0].pile).prototypes.size() +
                               instances(result.piles[1].pile).prototypes.size());
}

TEST(Build, HashDoesNotDependOnThreadsRunsOrCache) {
  const TemporaryFolder cache;
  const Recipe recipe = small_recipe();
  const std::string hash = make_report(build(recipe)).hash;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(make_report(build(recipe)).hash, hash) << threads;
  }
  for (int run = 0; run < 2; ++run)
    EXPECT_EQ(make_report(build(recipe, kept_in(cache.path()))).hash, hash);
}

TEST(Build, HashDependsOnTheRecipe) {
  const std::string hash = make_report(build(small_recipe())).hash;
  Recipe other_seed = small_recipe();
  other_seed.seed = 6;
  EXPECT_NE(make_report(build(other_seed)).hash, hash);
  Recipe other_size = small_recipe();
  std::get<PileOperation>(other_size.operations[0].params).pile.stone_size.value = 0.21;
  EXPECT_NE(make_report(build(other_size)).hash, hash);
}

TEST(Build, TakesStagesFromTheCache) {
  const TemporaryFolder cache;
  const BuildResult first = build(small_recipe(), kept_in(cache.path()));
  const BuildResult second = build(small_recipe(), kept_in(cache.path()));
  EXPECT_EQ(cached_stages(first), (std::vector<bool>{false, false, false}));
  EXPECT_EQ(cached_stages(second), (std::vector<bool>{true, true, false}));
}

TEST(Build, RemakesOnlyWhatChanged) {
  const TemporaryFolder cache;
  build(small_recipe(), kept_in(cache.path()));
  Recipe larger = small_recipe();
  std::get<PileOperation>(larger.operations[0].params).support = Shape(Sphere{.radius = 3});
  EXPECT_EQ(cached_stages(build(larger, kept_in(cache.path()))),
            (std::vector<bool>{true, false, false}));
  Recipe sharper = small_recipe();
  std::get<PileOperation>(sharper.operations[0].params).tiles.weathering.depth = 0;
  EXPECT_EQ(cached_stages(build(sharper, kept_in(cache.path()))),
            (std::vector<bool>{false, false, false}));
}

TEST(Build, RemakesDamagedCacheEntries) {
  const TemporaryFolder cache;
  const std::string hash = make_report(build(small_recipe(), kept_in(cache.path()))).hash;
  const std::vector<fs::path> entries = files_in(cache.path());
  ASSERT_EQ(entries.size(), 2u);
  for (const fs::path& entry : entries) {
    const std::string whole = read_file(entry);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() / 2), flipped}) {
      std::ofstream(entry, std::ios::binary) << damaged;
      EXPECT_EQ(make_report(build(small_recipe(), kept_in(cache.path()))).hash, hash);
      EXPECT_EQ(read_file(entry), whole) << "mended on disk";
    }
  }
}

TEST(Build, MeshesAreKnownByTheirContent) {
  const fs::path spot = fs::path(TALUS_TEST_DATA_DIR) / "mesh" / "spot.obj";
  NEEDS_TEST_DATA();
  const TemporaryFolder folder;
  fs::copy_file(spot, folder / "one.obj");
  Recipe recipe = small_recipe();
  auto& pile = std::get<PileOperation>(recipe.operations[0].params);
  pile.pile.stone_size.value = 0.1;
  pile.support = MeshSource{.mesh = folder / "one.obj"};
  const BuildParams params = kept_in(folder / "cache");
  const BuildResult first = build(recipe, params);
  EXPECT_EQ(cached_stages(first), (std::vector<bool>{false, false, false, false}));

  // The same mesh under another name is the same; another scale is not.
  fs::rename(folder / "one.obj", folder / "two.obj");
  pile.support = MeshSource{.mesh = folder / "two.obj"};
  EXPECT_EQ(cached_stages(build(recipe, params)), (std::vector<bool>{false, true, true, false}));
  pile.support = MeshSource{.mesh = folder / "two.obj", .read = {.scale = 2}};
  EXPECT_EQ(cached_stages(build(recipe, params)), (std::vector<bool>{false, true, false, false}));
}

TEST(Build, KnowsWhatHoldsAndWhatFloats) {
  const BuildResult result = build(small_recipe());
  Pile pile = result.piles[0].pile;
  EXPECT_EQ(check_pile(pile).groups, 1u);
  EXPECT_EQ(check_pile(pile).floating, 0u);

  // Two layers of cells taken out leave a cap with nothing below it.
  std::uint64_t above = 0;
  for (const PlacedStone& s : placed_stones(result.piles[0].pile)) {
    above += s.cell.z > 2;
    if (s.cell.z == 1 || s.cell.z == 2) remove_stone(pile, {.cell = s.cell});
  }
  ASSERT_LT(pile.stats.instances, result.piles[0].pile.stats.instances);
  const PileCheck check = check_pile(pile);
  EXPECT_GE(check.groups, 2u);
  EXPECT_EQ(check.floating, above);
}

// A bed of boulders, and gravel in what they leave.
constexpr std::string_view kTwoSizes = R"(
seed = 5
[[operation]]
type = "pile"
name = "boulders"
support = { shape = "box", size = [6, 6, 2] }
stone_size = 1.5
density = 0.5
tiles = { voxels_per_edge = 20 }
[[operation]]
type = "pile"
name = "gravel"
support = { shape = "box", size = [6, 6, 2] }
stone_size = 0.5
tiling = { at = [-3, -3, -1] }
tiles = { voxels_per_edge = 20 }
keep_out = [{ shape = "sphere", radius = 1 }]
keep_out_piles = ["boulders"]
removed = [[1, 1, 1]]
locked = [[1, 1, 30, 0]]
moved = [{ stone = [2, 2, 1], by = [0, 0, 5] }]
)";

TEST(Build, KeepsPilesOutOfPilesAndStonesAsTheHandLeftThem) {
  const TemporaryFolder cache;
  const auto built = [&](std::string text, std::string_view from = "", std::string_view to = "") {
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return build(read_recipe(parse_document(text, "two.toml")), kept_in(cache.path()));
  };
  const BuildResult result = built(std::string(kTwoSizes));
  const Pile& gravel = result.piles[1].pile;
  std::set<std::array<int, 3>> cells;
  for (const PlacedStone& s : placed_stones(gravel)) cells.insert({s.cell.x, s.cell.y, s.cell.z});
  EXPECT_FALSE(cells.contains({1, 1, 1}));
  EXPECT_TRUE(cells.contains({1, 1, 30}));
  EXPECT_FALSE(cells.contains({2, 2, 1}));
  ASSERT_EQ(gravel.moved.size(), 1u);
  EXPECT_GT(gravel.moved[0].position.z, 3.5);
  const auto report = nlohmann::json::parse(to_json(make_report(result)));
  EXPECT_EQ(report["piles"][1]["name"], "gravel");
  EXPECT_GT(report["piles"][1]["gap_fraction"], 0.05);

  // The cache knows what a pile was kept out of.
  EXPECT_TRUE(built(std::string(kTwoSizes)).stages[2].cached);
  const BuildResult other = built(std::string(kTwoSizes), "density = 0.5", "density = 0.9");
  EXPECT_FALSE(other.stages[2].cached);
  EXPECT_LT(other.piles[1].pile.stats.instances, gravel.stats.instances);

  try {
    built(std::string(kTwoSizes), "[\"boulders\"]", "[\"bolders\"]");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("no pile \"bolders\" comes before this one"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("boulders"), std::string::npos) << error.what();
  }
}

TEST(Build, AMaskSaysWhereStonesLie) {
  const TemporaryFolder folder;
  // West black, east white.
  const Image mask{.width = 2, .height = 1, .channels = 1, .pixels = {0, 255}};
  write_png(folder / "mask.png", mask);
  std::string text(kSmall);
  text.replace(text.find("name ="), 0, "density_mask = \"mask.png\"\n");
  const BuildResult result = build(read_recipe(parse_document(text, "a.toml"), folder.path()));
  const BuildResult whole = build(small_recipe());
  EXPECT_GT(result.stones.instances.size(), whole.stones.instances.size() / 4);
  EXPECT_LT(result.stones.instances.size(), 3 * whole.stones.instances.size() / 4);
  for (const Instance& stone : result.stones.instances) EXPECT_GE(stone.position.x, 0);
}

TEST(Build, MoreStonesThanMemoryHoldsAreRefusedBeforeTheyArePlaced) {
  Recipe recipe = small_recipe();
  auto& pile = std::get<PileOperation>(recipe.operations[0].params);
  pile.pile.stone_size.value = 0.01;
  try {
    build(recipe, {.memory_limit = 8 << 20});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::job);
    EXPECT_NE(std::string(error.what()).find("stones need about"), std::string::npos)
        << error.what();
  }
}

class RecordingJob : public Job {
 public:
  void warn(std::string_view message) override { warnings.emplace_back(message); }
  std::vector<std::string> warnings;
};

TEST(Build, WarnsOfAnOpenMeshAlsoFromTheCache) {
  const fs::path hole = fs::path(TALUS_TEST_DATA_DIR) / "mesh" / "sphere_with_hole.stl";
  NEEDS_TEST_DATA();
  const TemporaryFolder cache;
  Recipe recipe = small_recipe();
  std::get<PileOperation>(recipe.operations[0].params).support = MeshSource{.mesh = hole};
  for (int run = 0; run < 2; ++run) {
    RecordingJob job;
    build(recipe, kept_in(cache.path()), &job);
    ASSERT_EQ(job.warnings.size(), 1u);
    EXPECT_NE(job.warnings[0].find("the mesh is open (9 edges"), std::string::npos)
        << job.warnings[0];
  }
}

TEST(Build, WarnsOfAMeshThatCrossesItselfAlsoFromTheCache) {
  const fs::path file = fs::path(TALUS_TEST_DATA_DIR) / "mesh" / "self_intersectA.obj";
  NEEDS_TEST_DATA();
  const TemporaryFolder cache;
  Recipe recipe = small_recipe();
  auto& pile = std::get<PileOperation>(recipe.operations[0].params);
  pile.support = MeshSource{.mesh = file};
  pile.pile.stone_size.value = 0.1;
  for (int run = 0; run < 2; ++run) {
    RecordingJob job;
    build(recipe, kept_in(cache.path()), &job);
    EXPECT_EQ(
        std::count(job.warnings.begin(), job.warnings.end(),
                   file.string() + ": the mesh crosses or overlaps itself; the union is filled"),
        1);
  }
}

TEST(Build, AnUnusableCacheIsOnlyAWarning) {
  RecordingJob job;
  const BuildResult result = build(small_recipe(), kept_in("/dev/null/cache"), &job);
  EXPECT_FALSE(result.stones.instances.empty());
  ASSERT_FALSE(job.warnings.empty());
  EXPECT_TRUE(job.warnings[0].starts_with("the result is not kept for the next run: "));
}

TEST(Build, RefusesStonesLargerThanTheSupport) {
  Recipe recipe = small_recipe();
  std::get<PileOperation>(recipe.operations[0].params).pile.stone_size = {50};
  try {
    build(recipe);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

TEST(Build, StopsWhenCancelled) {
  Job job;
  job.cancel();
  EXPECT_THROW(build(small_recipe(), {}, &job), Cancelled);
}

TEST(Report, HasTheKeysOfTheSceneInOrder) {
  const nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(to_json(make_report(build(small_recipe()))));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"talus", "recipe", "seed", "threads", "hash", "stages",
                                            "tiles", "stones", "piles", "meshes", "checks"}));
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["talus"], std::string(version()));
  EXPECT_EQ(json["tiles"]["n"], 5);
  EXPECT_EQ(json["tiles"]["voxels_per_edge"], 20);
  EXPECT_EQ(json["meshes"]["stones"]["closed"], true);
  EXPECT_EQ(json["stages"].size(), 3u);
  for (const auto& check : json["checks"]) EXPECT_EQ(check["ok"], true) << check;
}

TEST(Report, RecipeBuildsTheSameScene) {
  const TemporaryFolder folder;
  const Report report = make_report(build(small_recipe()), folder.path());
  write_text(folder / "report.json", to_json(report));
  const Recipe recipe = load_reported_recipe(folder / "report.json");
  EXPECT_EQ(make_report(build(recipe)).hash, report.hash);
}

TEST(Report, RefusesOtherJson) {
  const TemporaryFolder folder;
  for (const char* text : {"", "[]", "{}", "{\"recipe\": 3}", "{\"recipe\": "}) {
    write_text(folder / "report.json", text);
    EXPECT_THROW(load_reported_recipe(folder / "report.json"), Error) << text;
  }
}

TEST(Outputs, WritesEveryFormatAsked) {
  const TemporaryFolder folder;
  Recipe recipe = small_recipe();
  recipe.output.formats =
      std::vector{Format::glb, Format::usda, Format::ply, Format::obj, Format::points, Format::csv};
  const auto files = write_scene(build(recipe), folder.path());
  EXPECT_EQ(files, (std::vector<fs::path>{folder / "scene.glb", folder / "scene.usda",
                                          folder / "scene.ply", folder / "scene.obj",
                                          folder / "stones.ply", folder / "stones.csv"}));
  for (const fs::path& file : files) EXPECT_GT(fs::file_size(file), 500u) << file;
  EXPECT_EQ(files_in(folder.path()).size(), 6u);
}

TEST(Outputs, AFolderWithoutFilesDisappears) {
  const TemporaryFolder folder;
  { const OutputFolder output(folder / "a/b/"); }
  EXPECT_FALSE(fs::exists(folder / "a"));
  {
    const OutputFolder output(folder / "a/b");
    write_text(folder / "a/b/file", "text");
  }
  EXPECT_TRUE(fs::exists(folder / "a/b/file"));
}

TEST(Outputs, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  write_text(folder / "file", "text");
  const auto kind = [](const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(kind([&] { OutputFolder output(folder / "file"); }), "");
  EXPECT_NE(kind([&] { OutputFolder output(folder / "file/below"); }), "");
  EXPECT_NE(kind([&] { check_writable_file(folder.path()); }), "");
  EXPECT_NE(kind([&] { check_writable_file(folder / "missing/file"); }), "");
  EXPECT_EQ(kind([&] { check_writable_file(folder / "file"); }), "");
}

}  // namespace
}  // namespace talus
