// Every recipe that comes with the project: with coarse tiles, large stones where a pile is alone,
// and landscapes as they are.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "talus/base/union_find.h"
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
    recipe.ground.sigma.reset();
    for (Operation& operation : recipe.operations) {
      auto* pile = std::get_if<PileOperation>(&operation.params);
      if (!pile) continue;
      pile->tiles.voxels_per_edge = 4 * pile->tiles.n;
      if (recipe.operations.size() == 1)
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

// How many pieces the ground is in, whether they touch the ground or float.
std::size_t pieces(const GroundMesh& ground) {
  UnionFind vertices(ground.ground_vertices);
  std::size_t count = ground.ground_vertices;
  for (std::size_t t = 0; t < ground.ground_triangles; ++t) {
    const Triangle& corners = ground.mesh.triangles[t];
    count -= vertices.join(corners.x, corners.y);
    count -= vertices.join(corners.y, corners.z);
  }
  return count;
}

struct Landscape {
  const char* name;
  std::size_t columns;
  double published_triangles;
};

// Beside the triangles that were published of such scenes: [Peytavie2009a] section 7 for the arches
// and the gorge, [Peytavie2010] for the cliff.
class Landscapes : public testing::TestWithParam<Landscape> {};

TEST_P(Landscapes, AreInOnePieceAndAsFineAsPublished) {
  const Landscape& landscape = GetParam();
  const fs::path file = fs::path(TALUS_SOURCE_DIR) / "scenes" / landscape.name;
  const BuildResult result = build(load_recipe(file));
  const GroundMesh& ground = result.terrain->ground;
  EXPECT_EQ(pieces(ground), 1u);
  const auto triangles = static_cast<double>(ground.ground_triangles);
  EXPECT_LT(triangles, 1.5 * landscape.published_triangles);
  EXPECT_GT(triangles, landscape.published_triangles / 1.5);

  const Report report = make_report(result);
  EXPECT_EQ(report.terrain->columns, landscape.columns);
  EXPECT_EQ(report.stones->floating, 0u);
  for (const Check& check : report.checks) EXPECT_TRUE(check.ok) << check.detail;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Landscapes,
                         testing::Values(Landscape{"arches.toml", 600 * 440, 360'698},
                                         Landscape{"gorge.toml", 1000 * 500, 760'769},
                                         Landscape{"cliff.toml", 2000 * 500, 742'615}),
                         [](const auto& instance) {
                           return fs::path(instance.param.name).stem().string();
                         });

}  // namespace
}  // namespace talus
