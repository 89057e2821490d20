// Every recipe that comes with the project, with coarse tiles and large stones.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "talus/scene/build.h"
#include "talus/scene/report.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Report> build_all_small() {
  std::map<std::string, Report> reports;
  for (const auto& entry : fs::directory_iterator(fs::path(TALUS_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    Recipe recipe = load_recipe(entry.path());
    if (recipe.terrain.cell) recipe.terrain.cell = 1;
    recipe.ground.cell.reset();
    for (Operation& operation : recipe.operations) {
      auto* pile = std::get_if<PileOperation>(&operation.params);
      if (!pile) continue;
      pile->tiles.voxels_per_edge = 4 * pile->tiles.n;
      if (!std::holds_alternative<LayerSource>(pile->support))
        pile->pile.stone_size = {0.08, RelativeLength::Unit::fraction};
    }
    reports[entry.path().stem().string()] = make_report(build(recipe));
  }
  return reports;
}

TEST(Scenes, BuildSmall) {
  const auto reports = build_all_small();
  EXPECT_GE(reports.size(), 1u);
  for (const auto& [name, report] : reports) {
    EXPECT_GT(report.stones->instances, 50u) << name;
    for (const Check& check : report.checks) EXPECT_TRUE(check.ok) << name << ": " << check.detail;
  }
}

// One hash per scene, the same from every compiler and on every machine. A change that is meant to
// alter what is made alters tests/golden/hashes.txt with it.
TEST(Scenes, HaveTheirGoldenHashes) {
  std::map<std::string, std::string> golden, made;
  std::ifstream file(fs::path(TALUS_SOURCE_DIR) / "tests/golden/hashes.txt");
  for (std::string name, hash; file >> name >> hash;) golden[name] = hash;
  for (const auto& [name, report] : build_all_small()) made[name] = report.hash;
  EXPECT_EQ(made, golden);
}

}  // namespace
}  // namespace talus
