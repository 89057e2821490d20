#include "talus/scene/recipe.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>

#include "temporary_folder.h"

namespace talus {
namespace {

Recipe read(std::string_view text) { return read_recipe(parse_document(text, "scene.toml")); }

std::string refusal(std::string_view text, std::string_view setting = {}) {
  try {
    Value document = parse_document(text, "scene.toml");
    if (!setting.empty()) apply_setting(document, setting);
    read_recipe(document);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

constexpr std::string_view kPile =
    "[[operation]]\ntype = \"pile\"\nsupport = { shape = \"sphere\" }\n";

// The recipe above with one line more, the fourth.
std::string pile_with(std::string_view line) { return fmt::format("{}{}\n", kPile, line); }

TEST(Recipe, ReadsEveryKindOfValue) {
  const Recipe recipe = read(R"(
seed = 42
[[operation]]
type = "pile"
name = "wall"
support = { mesh = "wall.ply", up = "y", scale = 0.01 }
stone_size = 0.25
surface_only = true
tiles = { n = 6, voxels_per_edge = 48, axis_z = 0.4, axis_x = [1, 1.5], weathering = { depth = 0 } }
[output]
formats = ["glb", "obj"]
instances = "nodes"
[view]
zoom = 2
ground = false
)");
  EXPECT_EQ(recipe.seed, 42u);
  const auto& pile = std::get<PileOperation>(recipe.operations.at(0).params);
  EXPECT_EQ(pile.name, "wall");
  const auto& source = std::get<MeshSource>(pile.support);
  EXPECT_EQ(source.mesh, "wall.ply");
  EXPECT_EQ(source.read.up, Axis::y);
  EXPECT_EQ(source.read.scale, 0.01);
  EXPECT_EQ(pile.pile.stone_size, (RelativeLength{0.25, RelativeLength::Unit::metres}));
  EXPECT_TRUE(pile.pile.surface_only);
  EXPECT_EQ(pile.tiles.n, 6);
  EXPECT_EQ(pile.tiles.voxels_per_edge, 48);
  EXPECT_EQ(pile.tiles.axis_z, (Range{0.4, 0.4}));
  EXPECT_EQ(pile.tiles.axis_x, (Range{1, 1.5}));
  EXPECT_EQ(pile.tiles.weathering.depth, 0);
  EXPECT_EQ(recipe.output.formats, (std::vector{Format::glb, Format::obj}));
  EXPECT_EQ(recipe.output.instances, InstanceMode::nodes);
  EXPECT_EQ(recipe.view.zoom, 2);
  EXPECT_FALSE(recipe.view.ground);
}

TEST(Recipe, LeavesOutMeanDefaults) {
  const Recipe recipe = read(kPile);
  EXPECT_EQ(recipe.seed, 1u);
  const auto& pile = std::get<PileOperation>(recipe.operations.at(0).params);
  EXPECT_EQ(pile.pile.stone_size, (RelativeLength{0.04, RelativeLength::Unit::fraction}));
  EXPECT_EQ(pile.tiles.n, 5);
  EXPECT_EQ(recipe.output.formats, std::nullopt);
}

TEST(Recipe, ReadsShapesInShapes) {
  const Recipe recipe = read(R"(
[[operation]]
type = "pile"
support = { shape = "subtract", parts = [
  { shape = "join", blend = 0.1, parts = [{ shape = "box", size = [1, 2, 3] }, { shape = "capsule" }] },
  { shape = "cylinder", radius = 0.2, height = 4 },
] }
)");
  const auto& pile = std::get<PileOperation>(recipe.operations.at(0).params);
  const auto& outer = std::get<Combination>(std::get<Shape>(pile.support));
  EXPECT_EQ(outer.rule, Combination::Rule::subtract);
  const auto& inner = std::get<Combination>(outer.parts.at(0));
  EXPECT_EQ(inner.blend, 0.1);
  EXPECT_EQ(std::get<Box>(inner.parts.at(0)).size, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Cylinder>(outer.parts.at(1)).height, 4);
}

TEST(Recipe, FilesAreRelativeToIt) {
  const Value document = parse_document(
      "[[operation]]\ntype = \"pile\"\nsupport = { mesh = \"a/b.ply\" }", "scene.toml");
  const auto mesh = [&](const std::filesystem::path& folder) {
    const Recipe recipe = read_recipe(document, folder);
    const auto& pile = std::get<PileOperation>(recipe.operations.at(0).params);
    return std::get<MeshSource>(pile.support).mesh;
  };
  EXPECT_EQ(mesh(""), "a/b.ply");
  EXPECT_EQ(mesh("scenes"), "scenes/a/b.ply");
  EXPECT_EQ(mesh("/data"), "/data/a/b.ply");
}

struct Refusal {
  std::string text;
  std::string line;
};

TEST(Recipe, RefusesWithFileLineKeyAndRemedy) {
  const std::vector<Refusal> refusals = {
      {"", "there is no [[operation]]; a recipe needs at least one"},
      {"sed = 1", "unknown key \"sed\"; did you mean \"seed\"?"},
      {"\n\n[veiw]\nzoom = 1", "unknown key \"veiw\"; did you mean \"view\"?"},
      {"[terrian]", "unknown key \"terrian\"; did you mean \"terrain\"?"},
      {"seed = \"one\"", "seed: \"one\" is wrong here; write an integer"},
      {"seed = 1.5", "seed: 1.5 is wrong here; write an integer"},
      {"seed = -1", "seed: -1 is out of range; it must be from 0 to 9223372036854775807"},
      {"view = 3", "view: 3 is wrong here; write a table"},
      {"[view]\nzoom = true", "view.zoom: true is wrong here; write a number"},
      {"[view]\nzoom = 1000", "view.zoom = 1000 is out of range; it must be from 0.05 to 100"},
      {"[view]\nzoom = nan", "view.zoom = nan is out of range; it must be from 0.05 to 100"},
      {"[view]\nground = 1", "view.ground: 1 is wrong here; write true or false"},
      {"[view]\neye = [0, 0, 1]", "view: give \"eye\" and \"target\" together, or none of them"},
      {"[view]\ncamera = \"inside\"", "view: camera = \"inside\" needs \"eye\" and \"target\""},
      {"[view]\neye = [0, 0, 1]\ntarget = [0, 0, 0]\nzoom = 1",
       "view.zoom: has no effect beside \"eye\"; leave one of them out"},
      {"[view]\ncamera = \"low\"\nelevation_deg = 9",
       "view.elevation_deg: has no effect beside camera = \"low\"; leave one of them out"},
      {"[output]\nformats = \"glb\"",
       "output.formats: one value is not enough; write a list of them"},
      {"[output]\nformats = [\"glb\", \"fbx\"]",
       "output.formats: unknown value \"fbx\"; there are glb, usda, ply, obj, points, csv"},
      {"[output]\ninstances = \"gpus\"",
       "output.instances: unknown value \"gpus\"; did you mean \"gpu\"?"},
      {"[operation]\ntype = \"pile\"", "operation: one value is not enough; write a list of them"},
      {"[[operation]]\nname = \"x\"",
       "operation: \"type\" is missing; there are heightmap, noise_terrain, primitive, "
       "mesh_bedrock, cover, sculpt, sweep, deposit, erode_surface, pile"},
      {"[[operation]]\ntype = \"pille\"",
       "operation: unknown operation \"pille\"; did you mean \"pile\"?"},
      {"[[operation]]\ntype = \"erode\"",
       "operation: unknown operation \"erode\"; there are heightmap, noise_terrain, primitive, "
       "mesh_bedrock, cover, sculpt, sweep, deposit, erode_surface, pile"},
      {"[[operation]]\ntype = 1", "operation.type: 1 is wrong here; write text in quotes"},
      {"[[operation]]\ntype = \"pile\"",
       "operation.pile: \"support\" is missing; write support = { mesh = \"FILE\" }, "
       "{ shape = \"sphere\", ... }, { formula = \"z < 1\", ... }, { lower = \"FILE\", upper = "
       "\"FILE\" } or the terrain's \"rocks\""},
      {pile_with("stone_sise = 1"),
       "operation.pile: unknown key \"stone_sise\"; did you mean \"stone_size\"?"},
      {pile_with("stone_size = \"big\""),
       "operation.pile.stone_size: \"big\" is no length; write metres (0.25) or a share of the "
       "longest side (4%)"},
      {pile_with("stone_size = 0"),
       "operation.pile.stone_size = 0 m is out of range; it must be at least 1e-06 m"},
      {pile_with("inside_fraction = 2"),
       "operation.pile.inside_fraction = 2 is out of range; it must be from 0.001 to 1"},
      {pile_with("name = \"\""), "operation.pile: \"name\" is empty; give a name or leave it out"},
      {pile_with("tiles = 5"), "operation.pile.tiles: 5 is wrong here; write a table"},
      {pile_with("tiles.n = 4"),
       "operation.pile.tiles.n = 4 cells is out of range; it must be from 5 to 16 cells"},
      {pile_with("tiles.n = 5.5"), "operation.pile.tiles.n: 5.5 is wrong here; write an integer"},
      {pile_with("tiles.n = 99999999999"),
       "operation.pile.tiles.n: 99999999999 is out of range; it must be from -2147483648 to "
       "2147483647"},
      {pile_with("tiles.axis_x = [1, 2, 3]"),
       "operation.pile.tiles.axis_x: a list is wrong here; write [min, max] or one number"},
      {pile_with("tiles.axis_x = [2, 1]"),
       "operation.pile.tiles.axis_x: range [2, 1] is reversed; give the smaller value first"},
      {pile_with("tiles.contacts.raduis = 1"),
       "operation.pile.tiles.contacts: unknown key \"raduis\"; did you mean \"radius\"?"},
      {"[[operation]]\ntype = \"pile\"\nsupport = \"rokcs\"",
       "operation.pile.support: unknown material \"rokcs\"; did you mean \"rocks\"?"},
      {"[[operation]]\ntype = \"primitive\"\nsupport = \"rocks\"",
       "operation.primitive.support: \"rocks\" is no support; write { mesh = \"FILE\" }, { shape = "
       "\"sphere\", ... }, { formula = \"z < 1\", ... } or { lower = \"FILE\", upper = \"FILE\" }"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { upper = \"a.tif\" }",
       "operation.pile.support: \"lower\" is missing; write lower = \"FILE\", a raster"},
      {"[[operation]]\ntype = \"heightmap\"",
       "operation.heightmap: \"file\" is missing; write file = \"FILE\""},
      {"[[operation]]\ntype = \"heightmap\"\nfile = \"a.tif\"\ncrop = [0, 0, 1]",
       "operation.heightmap.crop: a list is wrong here; write [x0, y0, x1, y1]"},
      {"[[operation]]\ntype = \"heightmap\"\nfile = \"a.tif\"\ncrop = [4, 0, 1, 9]",
       "operation.heightmap.crop: the rectangle is empty; give its lower corner first"},
      {"[[operation]]\ntype = \"cover\"\nmaterial = \"sandd\"",
       "operation.cover.material: unknown material \"sandd\"; did you mean \"sand\"?"},
      {"[[operation]]\ntype = \"cover\"\nmaterial = \"air\"",
       "operation.cover: \"material\" is air; a cover is of sand, soil or snow"},
      {"[[operation]]\ntype = \"cover\"\nmaterial = \"rocks\"",
       "operation.cover: \"material\" is rocks; a cover is of sand, soil or snow"},
      {"[terrain]\nsize = [100, -1]",
       "terrain.size = -1 m is out of range; it must be from 0.001 to 10000000 m"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { up = \"z\" }",
       "operation.pile.support: this value is no support; write { mesh = \"FILE\" }, "
       "{ shape = \"sphere\", ... }, { formula = \"z < 1\", ... }, { lower = \"FILE\", upper = "
       "\"FILE\" } or the terrain's \"rocks\""},
      {"[[operation]]\ntype = \"pile\"\nsupport = { mesh = \"\" }",
       "operation.pile.support.mesh: \"\" is wrong here; write a file name in quotes"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { mesh = \"a\", shape = \"box\" }",
       "operation.pile.support: \"mesh\" and \"shape\" at once; give one of them"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { formula = \"z < sine(x)\", min = [0, 0, 0], "
       "max = [1, 1, 1] }",
       "operation.pile.support.formula: column 5: unknown name \"sine\"; did you mean \"sin\"?"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { formula = \"z < 1\", min = [0, 0, 0] }",
       "operation.pile.support: \"max\" is missing; write max = [X, Y, Z], a corner of the box "
       "that "
       "the formula is asked in"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { mesh = \"a\", up = \"w\" }",
       "operation.pile.support.up: unknown value \"w\"; there are x, y, z"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"spere\" }",
       "operation.pile.support: unknown shape \"spere\"; did you mean \"sphere\"?"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"sphere\", radius = -1 }",
       "operation.pile.support.radius = -1 m is out of range; it must be from 1e-06 to 1000000000 "
       "m"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"box\", center = [0, 1] }",
       "operation.pile.support.center: a list is wrong here; write [x, y, z]"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"join\" }",
       "operation.pile.support: \"parts\" is missing or empty; give the shapes to combine"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"join\", parts = [{ radius = 1 }] }",
       "operation.pile.support.parts: \"shape\" is missing; write { shape = \"sphere\", ... }"},
      {"[[operation]]\ntype = \"pile\"\nsupport = { shape = \"join\", blend = -1, parts = [] }",
       "operation.pile.support.blend: -1 is out of range; it must be at least 0 m"},
  };
  for (const Refusal& expected : refusals) {
    const std::string line = refusal(expected.text);
    // The fault is in the last line that has text, except where a whole table is at fault.
    EXPECT_TRUE(line.starts_with("scene.toml:")) << line;
    const std::size_t after_place = line.find(": ");
    ASSERT_NE(after_place, std::string::npos) << expected.text;
    EXPECT_EQ(line.substr(after_place + 2), expected.line) << expected.text;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(Recipe, NamesTheLineOfTheFault) {
  EXPECT_TRUE(refusal(pile_with("stone_sise = 1")).starts_with("scene.toml:4: "));
  EXPECT_TRUE(refusal(pile_with("\n\ntiles.n = 4")).starts_with("scene.toml:6: "));
  EXPECT_TRUE(refusal("seed = 1\n[veiw]\nzoom = 1").starts_with("scene.toml:2: "));
  EXPECT_TRUE(refusal("seed = 1\n\n[[operation]]\nname = \"x\"").starts_with("scene.toml:3: "));
}

TEST(Recipe, NamesTheSettingAtFault) {
  EXPECT_EQ(
      refusal(kPile, "operation.0.tiles.n=4"),
      "--set operation.0.tiles.n=4: operation.pile.tiles.n = 4 cells is out of range; it must "
      "be from 5 to 16 cells");
  EXPECT_EQ(refusal(kPile, "operation.0.stone_sise=4%"),
            "--set operation.0.stone_sise=4%: operation.pile: unknown key \"stone_sise\"; did you "
            "mean \"stone_size\"?");
  EXPECT_EQ(refusal(kPile, "view=3"), "--set view=3: view: 3 is wrong here; write a table");
}

TEST(Recipe, SuggestsTheNearestName) {
  const std::vector<std::string> names = {"stone_size", "inside_fraction", "tiles"};
  EXPECT_EQ(suggest("stonesize", names), "did you mean \"stone_size\"?");
  EXPECT_EQ(suggest("tielss", names), "did you mean \"tiles\"?");
  EXPECT_EQ(suggest("xyzzy", names), "there are stone_size, inside_fraction, tiles");
  EXPECT_EQ(suggest("xyzzy", std::vector<std::string>{"pile"}), "there is only pile");
  EXPECT_EQ(suggest("TILES", names), "did you mean \"tiles\"?");
  EXPECT_EQ(suggest("w", std::vector<std::string>{"x", "y"}), "there are x, y")
      << "no letter is right";
}

TEST(Recipe, CapitalsDoNotMatterInChoices) {
  const Recipe recipe = read(fmt::format("{}[output]\nformats = [\"PLY\"]", kPile));
  EXPECT_EQ(recipe.output.formats, std::vector{Format::ply});
}

TEST(Recipe, EveryOperationIsListedWithItsKeys) {
  for (const OperationType& type : operation_types()) {
    // What must be given, of an operation that has such a key.
    std::string keys;
    for (const KeyHelp& key : list_keys(type)) {
      if (key.path == "support") keys = "support = { shape = \"sphere\" }";
      if (key.path == "points") keys = "points = [[1, 2]]";
      if (key.path == "nodes")
        keys = "nodes = [[1, 2], [3, 4]]\nprofile = [[1, 0], [0, 1], [-1, 0]]";
      if (key.path == "volume") keys += "\nvolume = 3";
      if (key.path == "file" || key.path == "mesh") keys = key.path + " = \"a.file\"";
    }
    const Recipe recipe = read(fmt::format("[[operation]]\ntype = \"{}\"\n{}", type.name, keys));
    EXPECT_EQ(recipe.operations.at(0).params.index(), type.defaults.params.index());
    for (const KeyHelp& key : list_keys(type)) {
      EXPECT_FALSE(key.help.empty()) << key.path;
      EXPECT_FALSE(key.type.empty()) << key.path;
    }
  }
}

// Random recipes whose every key may differ from its default.

double random_number(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1 << 20) / double(1 << 20);
}

Shape random_shape(int depth) {
  const auto point = [] {
    return Vec3(random_number(-9, 9), random_number(-9, 9), random_number(-9, 9));
  };
  switch (*rc::gen::inRange(0, depth > 0 ? 5 : 4)) {
    case 0:
      return Sphere{.center = point(), .radius = random_number(0.1, 3)};
    case 1:
      return Box{.center = point(), .size = Vec3(random_number(0.1, 3)), .rounding = 0.01};
    case 2:
      return Capsule{.from = point(), .to = point(), .to_radius = random_number(0.1, 3)};
    case 3:
      return Cylinder{.base = point(), .height = random_number(0.1, 3)};
    default: {
      Combination combination{
          .rule = *rc::gen::element(Combination::Rule::join, Combination::Rule::subtract,
                                    Combination::Rule::intersect),
          .blend = random_number(0, 1)};
      const int parts = *rc::gen::inRange(1, 4);
      for (int i = 0; i < parts; ++i) combination.parts.push_back(random_shape(depth - 1));
      return combination;
    }
  }
}

PileOperation random_pile() {
  PileOperation pile;
  pile.name = *rc::gen::nonEmpty(rc::gen::string<std::string>());
  std::erase_if(pile.name, [](char c) { return c <= 0; });  // TOML is UTF-8 without NUL
  pile.name += "x";
  if (*rc::gen::arbitrary<bool>())
    pile.support = random_shape(2);
  else
    pile.support = MeshSource{.mesh = "folder/mesh.ply",
                              .read = {.up = Axis::x, .scale = random_number(0.1, 10)}};
  pile.pile.stone_size =
      *rc::gen::arbitrary<bool>()
          ? RelativeLength{random_number(0.1, 1)}
          : RelativeLength{*rc::gen::inRange(1, 100) / 100.0, RelativeLength::Unit::fraction};
  pile.pile.surface_only = *rc::gen::arbitrary<bool>();
  pile.pile.surface_depth = random_number(1, 100);
  pile.tiles.n = *rc::gen::inRange(5, 9);
  if (*rc::gen::arbitrary<bool>()) pile.tiles.voxels_per_edge = 10 * pile.tiles.n;
  pile.tiles.axis_y = {random_number(0.1, 1), random_number(1, 2)};
  pile.tiles.weathering.depth = random_number(0, 0.5);
  return pile;
}

DepositOperation random_deposit() {
  DepositOperation deposit;
  deposit.region.points = {{{random_number(0, 9), random_number(0, 9)}, {}},
                           {{random_number(0, 9), 1}, random_number(0, 9)}};
  if (*rc::gen::arbitrary<bool>()) deposit.region.mask = "folder/mask.png";
  deposit.deposit.profile = *rc::gen::element(DepositProfile::noise, DepositProfile::map);
  if (deposit.deposit.profile == DepositProfile::map) deposit.map = "folder/map.tif";
  auto& amount = *rc::gen::arbitrary<bool>() ? deposit.deposit.height : deposit.deposit.volume;
  amount = random_number(0, 9);
  deposit.deposit.brush.radius = random_number(0.1, 9);
  return deposit;
}

TEST(Recipe, ReadsBackWhatItWrites) {
  rc::check([] {
    Recipe recipe;
    recipe.seed = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 62);
    const int operations = *rc::gen::inRange(1, 4);
    for (int i = 0; i < operations; ++i) recipe.operations.push_back({random_pile()});
    recipe.operations.push_back({random_deposit()});
    recipe.output.formats = std::vector{Format::ply, Format::glb};
    if (*rc::gen::arbitrary<bool>()) recipe.output.target = Target::houdini;
    recipe.output.instances = *rc::gen::element(InstanceMode::gpu, InstanceMode::flattened);
    recipe.view.zoom = random_number(0.1, 10);
    recipe.view.ground = *rc::gen::arbitrary<bool>();

    const std::string text = to_toml(recipe);
    const Recipe again = read(text);
    RC_ASSERT(write_value(again) == write_value(recipe));
    RC_ASSERT(to_toml(again) == text);
  });
}

TEST(Recipe, SweepsSurviveBeingWritten) {
  const std::string text = R"(seed = 1

[[operation]]
type = "sweep"
profile = [[2.0, 0.0], [0.0, 2.0], [-2.0, 0.0]]
nodes = [[0.0, 0.0], [5.0, 1.0, 2.0], { at = [0.0, 9.0], scale = 2.0 }, { at = [0.0, 0.0, 4.0], profile = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]] }]
arcs = [[0, 1], [1, 2], [1, 3]]
projected = true
)";
  EXPECT_EQ(to_toml(read(text)), text);
}

TEST(Recipe, WritesOnlyWhatDiffers) {
  EXPECT_EQ(to_toml(read(kPile)),
            "seed = 1\n\n[[operation]]\ntype = \"pile\"\nsupport = { shape = \"sphere\" }\n");
}

TEST(Recipe, KeepsFilesWhenItMoves) {
  Recipe recipe = read(
      "[[operation]]\ntype = \"pile\"\nsupport = { mesh = \"data/a.ply\" }\n[[operation]]\n"
      "type = \"deposit\"\nheight = 1\nmask = \"data/m.png\"\nprofile = \"map\"\n"
      "map = \"data/h.tif\"\n[[operation]]\ntype = \"erode_surface\"\nmask = \"data/e.png\"\n");
  const std::string text = to_toml(recipe, "out/deep");
  for (const std::string_view file : {"a.ply", "m.png", "h.tif", "e.png"})
    EXPECT_NE(text.find(fmt::format(" = \"../../data/{}\"", file)), std::string::npos) << text;
}

TEST(Recipe, RefusesASeedThatTomlCannotHold) {
  Recipe recipe = read(kPile);
  recipe.seed = ~std::uint64_t{0};
  EXPECT_THROW(to_toml(recipe), Error);
}

TEST(Recipe, ShapesOnTheCommandLine) {
  const auto text = [](std::string_view spec) { return to_text(parse_support(spec, "it")); };
  EXPECT_EQ(text("angel.ply"), "{ mesh = \"angel.ply\" }");
  EXPECT_EQ(text("sphere"), "{ shape = \"sphere\" }");
  EXPECT_EQ(text("sphere:radius=2,center=[0,0,1]"),
            "{ shape = \"sphere\", radius = 2, center = [0, 0, 1] }");
  EXPECT_EQ(text("C:/angel.ply"), "{ mesh = \"C:/angel.ply\" }");
  EXPECT_THROW(parse_support("sphere:radius", "it"), Error);
  // Nearly a shape's name, or with keys like one.
  EXPECT_THROW(parse_support("spere", "it"), Error);
  EXPECT_THROW(parse_support("thing:radius=2", "it"), Error);
  const TemporaryFolder folder;
  const std::string file = folder.path() / "spere:radius=2";
  std::ofstream(file) << "a file";
  EXPECT_EQ(text(file), fmt::format("{{ mesh = \"{}\" }}", file));
}

}  // namespace
}  // namespace talus
