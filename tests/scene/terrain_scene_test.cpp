// Recipes with terrain, from the text to the report.
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "talus/base/parallel.h"
#include "talus/io/png.h"
#include "talus/scene/build.h"
#include "talus/scene/report.h"
#include "temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

// Noise, a cave, sand, and stones that fill a layer of rocks.
constexpr std::string_view kScene = R"(
seed = 3
[terrain]
size = [16, 12]
cell = 0.5
[ground]
skirt = 1
[[operation]]
type = "noise_terrain"
height = 6
relief = 2
feature_size = 8
[[operation]]
type = "primitive"
support = { shape = "capsule", from = [-1, 6, 3], to = [17, 6, 4], from_radius = 1.5, to_radius = 1.5 }
roughness = 0.3
[[operation]]
type = "primitive"
material = "rocks"
replaces = ["air"]
support = { shape = "sphere", center = [8, 6, 2.5], radius = 1.6 }
[[operation]]
type = "cover"
material = "sand"
thickness = 0.2
[[operation]]
type = "pile"
support = "rocks"
stone_size = 0.5
tiles = { n = 5, voxels_per_edge = 20 }
)";

Recipe recipe_of(std::string_view text, const fs::path& folder = {}) {
  return read_recipe(parse_document(text, "scene.toml"), folder);
}

std::string message_of(auto&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(TerrainScene, MakesGroundAndStonesThatPassTheirChecks) {
  const BuildResult result = build(recipe_of(kScene));
  const Report report = make_report(result);
  ASSERT_TRUE(report.terrain);
  EXPECT_EQ(report.terrain->columns, 32u * 24u);
  EXPECT_EQ(report.ledger.size(), 4u);
  ASSERT_TRUE(report.stones);
  EXPECT_GT(report.stones->instances, 10u);
  EXPECT_EQ(report.meshes.front().first, "ground");
  EXPECT_TRUE(report.meshes.front().second.closed) << "the skirt closes it";
  for (const Check& check : report.checks) EXPECT_TRUE(check.ok) << check.detail;
  EXPECT_FALSE(result.plane);

  // The tunnel goes through, and holds sand and stones.
  const LayeredTerrain& terrain = result.terrain->terrain;
  EXPECT_EQ(terrain.material(Vec3(4.2, 6.2, 3.7)), Material::air);
  EXPECT_GT(terrain.volume()[static_cast<std::size_t>(Material::sand)], 0);
  for (const Instance& stone : result.stones.instances)
    EXPECT_LT(glm::length(Vec3(stone.position) - Vec3(8, 6, 2.5)), 3);
}

TEST(TerrainScene, LedgerTellsWhatBecameOfTheVolumes) {
  const BuildResult result = build(recipe_of(kScene));
  MaterialSteps booked{};
  for (const LedgerEntry& entry : result.terrain->ledger) {
    EXPECT_TRUE(entry.balanced) << entry.operation;
    const MaterialSteps change = entry.booking.change();
    for (std::size_t m = 0; m < booked.size(); ++m) booked[m] += change[m];
  }
  EXPECT_EQ(booked, result.terrain->terrain.volume()) << "all began with nothing above the floor";
}

TEST(TerrainScene, ThreadsAndCacheDoNotShow) {
  const TemporaryFolder cache;
  const Recipe recipe = recipe_of(kScene);
  std::string once;
  {
    const ThreadLimit limit(1);
    once = make_report(build(recipe)).hash;
  }
  const BuildParams kept{.cache_folder = cache.path()};
  EXPECT_EQ(make_report(build(recipe, kept)).hash, once);
  const BuildResult again = build(recipe, kept);
  EXPECT_EQ(make_report(again).hash, once);
  int cached = 0;
  for (const Stage& stage : again.stages) cached += stage.cached;
  EXPECT_EQ(cached, 6) << "four changes of the terrain, tiles, pile";

  // A change in the middle lapses what follows and nothing before.
  Recipe changed = recipe;
  std::get<PrimitiveOperation>(changed.operations[1].params).fill.roughness = 0.1;
  const BuildResult other = build(changed, kept);
  EXPECT_TRUE(other.stages[0].cached);
  EXPECT_FALSE(other.stages[1].cached);
  EXPECT_NE(make_report(other).hash, once);
}

TEST(TerrainScene, ReportSaysWhatThereIs) {
  const auto json = nlohmann::json::parse(to_json(make_report(build(recipe_of(kScene)))));
  EXPECT_EQ(json["terrain"]["columns"], 768);
  EXPECT_EQ(json["terrain"]["step_m"], 0.001);
  EXPECT_GT(json["terrain"]["volume_steps"]["bedrock"], 1'000'000);
  EXPECT_EQ(json["ledger"][0]["operation"], "noise_terrain");
  EXPECT_GT(json["ledger"][1]["removed"]["bedrock"], 1000);
  EXPECT_TRUE(json["ledger"][3]["balanced"]);
}

TEST(TerrainScene, ThreadsDoNotShowOverManyTiles) {
  const Recipe recipe = recipe_of(R"(
[terrain]
size = [50, 40]
cell = 0.25
[[operation]]
type = "noise_terrain"
relief = 4
[[operation]]
type = "primitive"
support = { shape = "capsule", from = [0, 20, -2], to = [50, 20, -1], from_radius = 3, to_radius = 3 }
roughness = 0.5
[[operation]]
type = "cover"
coverage = 0.5
)");
  std::string once;
  {
    const ThreadLimit limit(1);
    once = make_report(build(recipe)).hash;
  }
  EXPECT_EQ(make_report(build(recipe)).hash, once);
}

TEST(TerrainScene, APlacedMeshBecomesBedrock) {
  const TemporaryFolder folder;
  // A box 4 m x 2 m x 2 m, lying along x, in a file whose z is up.
  std::ofstream(folder.path() / "box.off")
      << "OFF\n8 6 0\n-2 -1 -1\n2 -1 -1\n2 1 -1\n-2 1 -1\n-2 -1 1\n2 -1 1\n2 1 1\n-2 1 1\n"
         "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const BuildResult result = build(recipe_of(R"(
[terrain]
size = [10, 10]
cell = 0.25
[[operation]]
type = "mesh_bedrock"
mesh = "box.off"
rotate_deg = [0, 0, 90]
at = [5, 5, 6]
)",
                                             folder.path()));
  const LayeredTerrain& terrain = result.terrain->terrain;
  EXPECT_EQ(terrain.material(Vec3(5.1, 6.9, 6)), Material::bedrock) << "turned along y";
  EXPECT_EQ(terrain.material(Vec3(6.9, 5.1, 6)), Material::air);
  EXPECT_EQ(terrain.material(Vec3(5.1, 5.1, 4.5)), Material::air) << "it floats";
  EXPECT_EQ(result.terrain->ledger[0].booking.added(Material::bedrock), 8 * 16 * 2000);
}

std::string hill_at(double west) {
  return fmt::format("ncols 2\nnrows 2\nxllcorner {}\nyllcorner 5000000\ncellsize 2\n7 7\n7 7\n",
                     west);
}

TEST(TerrainScene, ASecondRasterLiesWhereItBelongs) {
  const TemporaryFolder folder;
  const std::string crs =
      "PROJCS[\"UTM 32N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
      "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
      "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
      "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
      "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";
  for (const auto& [name, west] : {std::pair("a", 600000.0), std::pair("b", 600002.0)}) {
    std::ofstream(folder.path() / fmt::format("{}.asc", name)) << hill_at(west);
    std::ofstream(folder.path() / fmt::format("{}.prj", name)) << crs;
  }
  const BuildResult result = build(recipe_of(R"(
[terrain]
size = [8, 4]
[[operation]]
type = "heightmap"
file = "a.asc"
[[operation]]
type = "heightmap"
file = "b.asc"
)",
                                             folder.path()));
  const LayeredTerrain& terrain = result.terrain->terrain;
  for (int x = 0; x < 4; ++x) EXPECT_EQ(terrain.column(x, 0).empty(), x == 3) << x;
}

// A bed a metre thick over a slope.
TEST(TerrainScene, StonesLieBetweenTwoRasters) {
  const TemporaryFolder folder;
  for (const auto& [name, base] : {std::pair("low", 0), std::pair("high", 1)}) {
    std::ofstream file(folder.path() / fmt::format("{}.asc", name));
    file << "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) file << 0.5 * x + base << (x < 3 ? " " : "\n");
  }
  const BuildResult result = build(recipe_of(R"(
[[operation]]
type = "pile"
support = { lower = "low.asc", upper = "high.asc" }
stone_size = 0.2
inside_fraction = 1
tiles = { voxels_per_edge = 20 }
)",
                                             folder.path()));
  const auto slope = [](double x) { return 0.5 * std::clamp(x - 0.5, 0.0, 3.0); };
  ASSERT_GT(result.stones.instances.size(), 500u);
  double lowest = 1, highest = 0;
  for (const Instance& stone : result.stones.instances)
    for (const Vec3f& local : result.stones.prototypes[stone.prototype]->positions) {
      const Vec3 p = world_from_local(stone, local);
      lowest = std::min(lowest, p.z - slope(p.x));
      highest = std::max(highest, p.z - slope(p.x));
    }
  // Centers of voxels of 5 cm lie inside, the surface within one of them.
  EXPECT_GT(lowest, -0.05);
  EXPECT_LT(lowest, 0.1);
  EXPECT_LT(highest, 1.05);
  EXPECT_GT(highest, 0.9);
}

TEST(TerrainScene, TwoRastersMustBeOfOnePlace) {
  const TemporaryFolder folder;
  for (const auto& [name, west] : {std::pair("low", 0), std::pair("high", 10)})
    std::ofstream(folder.path() / fmt::format("{}.asc", name)) << hill_at(west);
  try {
    build(
        recipe_of("[[operation]]\ntype = \"pile\"\nsupport = { lower = \"low.asc\", upper = "
                  "\"high.asc\" }\n",
                  folder.path()));
    FAIL() << "built";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("give two rasters of the same place"),
              std::string::npos);
  }
}

TEST(TerrainScene, RasterSetsTheExtent) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "hill.asc") << "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\n"
                                               "cellsize 2\nNODATA_value -9999\n"
                                               "1 2 3 4\n2 3 4 5\n3 4 5 6\n";
  const BuildResult result =
      build(recipe_of("[[operation]]\ntype = \"heightmap\"\nfile = \"hill.asc\"\n", folder.path()));
  const TerrainGrid& grid = result.terrain->terrain.grid();
  EXPECT_EQ(grid.nx, 4);
  EXPECT_EQ(grid.ny, 3);
  EXPECT_EQ(grid.cell, 2);
  EXPECT_EQ(result.terrain->terrain.column(0, 0).back().top(), 3000) << "rows run from the north";
  EXPECT_EQ(result.terrain->terrain.column(3, 2).back().top(), 4000);
}

TEST(TerrainScene, ARasterWithoutPlaceFitsColumnsOfAnyWidth) {
  const TemporaryFolder folder;
  Image ramp{.width = 20, .height = 10, .channels = 1};
  for (int i = 0; i < 20 * 10; ++i)
    ramp.pixels.push_back(static_cast<std::uint8_t>(10 + 3 * (i % 20)));
  write_png(folder.path() / "ramp.png", ramp);
  const BuildResult result = build(recipe_of(R"(
[terrain]
size = [60, 30]
cell = 0.5
[[operation]]
type = "heightmap"
file = "ramp.png"
pixel_size = 3
)",
                                             folder.path()));
  const LayeredTerrain& terrain = result.terrain->terrain;
  for (int x = 10; x < 110; ++x)
    EXPECT_NEAR(terrain.height_of(terrain.column(x, 30).back().top()), 8.5 + 0.5 * (x + 0.5), 0.01)
        << x;
}

struct Listener : Job {
  void warn(std::string_view line) override { warnings.emplace_back(line); }
  std::vector<std::string> warnings;
};

TEST(TerrainScene, TellsOfRocksThatNoPileFills) {
  std::string text(kScene);
  const auto warnings_of = [](std::string_view scene) {
    Listener job;
    build(recipe_of(scene), {}, &job);
    return job.warnings;
  };
  const std::string line =
      "the terrain's rocks do not show, because no pile fills them; add an operation of type "
      "\"pile\" with support = \"rocks\"";
  const auto told = [&](const std::vector<std::string>& warnings) {
    return std::count(warnings.begin(), warnings.end(), line);
  };
  EXPECT_EQ(told(warnings_of(text)), 0);
  text.erase(text.rfind("[[operation]]"));
  EXPECT_EQ(told(warnings_of(text)), 1);
}

TEST(TerrainScene, DropsWhatAMaskLetsThroughAndAMapShapes) {
  const TemporaryFolder folder;
  Image ramp{.width = 20, .height = 10, .channels = 1};
  for (int i = 0; i < 20 * 10; ++i) ramp.pixels.push_back(static_cast<std::uint8_t>(i % 20));
  write_png(folder.path() / "ramp.png", ramp);
  Image mask{.width = 32, .height = 24, .channels = 1};
  for (int i = 0; i < 32 * 24; ++i) mask.pixels.push_back(i < 32 * 12 ? 255 : 0);
  write_png(folder.path() / "north.png", mask);
  const auto scene = [&](int metres_north, std::string_view operation) {
    return recipe_of(fmt::format("[terrain]\nsize = [16, {}]\ncell = 0.5\n[[operation]]\n{}",
                                 metres_north, operation),
                     folder.path());
  };
  const std::string deposit =
      "type = \"deposit\"\nheight = 2\nmask = \"north.png\"\npoints = [[8, 6]]\nradius = 4\n"
      "profile = \"map\"\nmap = \"ramp.png\"\n";
  const LayeredTerrain terrain = build(scene(12, deposit)).terrain->terrain;
  const auto sand = [&](double x, double y) {
    return terrain.material(Vec3(x, y, 1.5)) == Material::sand;
  };
  EXPECT_TRUE(sand(11.7, 9.7)) << "the ramp is high in the east";
  EXPECT_FALSE(sand(4.3, 9.7));
  EXPECT_FALSE(sand(11.7, 5.7)) << "masked";
  EXPECT_EQ(
      message_of([&] { build(scene(13, deposit)); }),
      fmt::format("scene.toml:4: operation.deposit: {}: a mask of 32 x 24 pixels; it must have one "
                  "for each column of the terrain, 32 x 26",
                  (folder.path() / "north.png").string()));
}

TEST(TerrainScene, IsMadeAnewWhenAMaskHasChanged) {
  const TemporaryFolder folder, kept;
  const Recipe recipe = recipe_of(
      "[terrain]\nsize = [8, 8]\ncell = 1\n[[operation]]\ntype = \"erode_surface\"\n"
      "mask = \"mask.png\"\n",
      folder.path());
  std::set<std::string> hashes;
  for (const std::uint8_t grey : std::vector<std::uint8_t>{100, 200}) {
    write_png(folder.path() / "mask.png",
              {.width = 8, .height = 8, .channels = 1, .pixels = std::vector(64, grey)});
    hashes.insert(make_report(build(recipe, {.cache_folder = kept.path()})).hash);
  }
  EXPECT_EQ(hashes.size(), 2u);
}

TEST(TerrainScene, TellsWhatOfAVolumeFoundNoRoom) {
  const TemporaryFolder kept;
  const Recipe recipe = recipe_of(R"(
[terrain]
size = [8, 8]
cell = 0.5
floor = -5
[[operation]]
type = "primitive"
support = { shape = "box", center = [4, 4, -2], size = [2, 2, 1] }
[[operation]]
type = "deposit"
points = [[4, 4, -2]]
volume = 6
)");
  for (const bool cached : {false, true}) {
    Listener listener;
    const BuildResult result = build(recipe, {.cache_folder = kept.path()}, &listener);
    EXPECT_EQ(result.stages[1].cached, cached);
    ASSERT_EQ(listener.warnings.size(), 1u);
    EXPECT_EQ(listener.warnings[0], "deposit: only 4 of 6 m^3 of sand found room");
  }
}

TEST(TerrainScene, TellsOfWallsThatDoNotShow) {
  const auto scene = [](std::string_view wide) {
    return recipe_of(fmt::format(R"(
[terrain]
size = [16, 12]
cell = 0.5
[[operation]]
type = "primitive"
material = "bedrock"
support = {{ shape = "box", center = [8.25, 6, 0], size = [{}, 8, 6] }}
)",
                                 wide));
  };
  Listener thin, thick;
  const Report report = make_report(build(scene("0.5"), {}, &thin));
  EXPECT_EQ(report.terrain->mesh_columns_lost, 16u);
  ASSERT_EQ(thin.warnings.size(), 1u);
  EXPECT_EQ(thin.warnings[0],
            "ground mesh: 16 of 768 columns (2.1 %) end in tips, walls or slabs thinner than about "
            "0.5 m, which it leaves out; thicker forms or terrain.cell = 0.25 would show more of "
            "them");
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["terrain"]["mesh_columns_lost"], 16);
  EXPECT_EQ(make_report(build(scene("1.5"), {}, &thick)).terrain->mesh_columns_lost, 0u);
  EXPECT_TRUE(thick.warnings.empty());
}

TEST(TerrainScene, IsASolidBlockUnlessTheRecipeOpensIt) {
  const auto closed = [](std::string_view ground) {
    const Recipe recipe = recipe_of(fmt::format(
        "[terrain]\nsize = [20, 10]\n{}\n[[operation]]\ntype = \"noise_terrain\"\n", ground));
    return make_report(build(recipe)).meshes.front().second.closed;
  };
  EXPECT_TRUE(closed(""));
  EXPECT_FALSE(closed("[ground]\nskirt = 0"));
  EXPECT_FALSE(closed("[ground]\nbase = false"));
}

TEST(TerrainScene, WhatCannotBeIsRefusedInOneLine) {
  const TemporaryFolder folder;
  const auto refusal = [&](std::string_view text) {
    return message_of([&] { build(recipe_of(text, folder.path())); });
  };
  EXPECT_EQ(refusal("[[operation]]\ntype = \"heightmap\"\nfile = \"no.tif\"\n"),
            "scene.toml:1: operation.heightmap: " + (folder.path() / "no.tif").string() +
                ": cannot read: no such file");
  EXPECT_EQ(refusal("[[operation]]\ntype = \"pile\"\nsupport = \"rocks\"\n"),
            "scene.toml:1: operation.pile: there is no terrain whose layers of rocks could be "
            "filled; put an operation "
            "that makes one before it");
  EXPECT_NE(refusal("[terrain]\nsize = [1e6, 10]\ncell = 0.01\n[[operation]]\n"
                    "type = \"noise_terrain\"\n")
                .find("there can be 1 to"),
            std::string::npos);
}

TEST(TerrainScene, TooMuchMemoryIsRefusedBeforeItIsTaken) {
  const Recipe recipe = recipe_of(
      "[terrain]\nsize = [10000, 10000]\ncell = 1\n[[operation]]\ntype = \"noise_terrain\"\n");
  try {
    build(recipe, {.memory_limit = std::uint64_t{1} << 30});
    FAIL() << "it was built";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::job);
    EXPECT_EQ(std::string(error.what()),
              "scene.toml:4: operation.noise_terrain: a terrain of 10000 x 10000 columns takes "
              "about 20.0 GB, but only 1.1 GB may be used; "
              "choose larger cells, 4.75 m for example");
  }
}

}  // namespace
}  // namespace talus
