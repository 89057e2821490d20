#include "talus/io/usda_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "io/scenes.h"
#include "io/scratch.h"
#include "talus/base/parallel.h"

namespace talus {
namespace {

using test::bytes_of;
using test::heap;
using test::Scratch;

constexpr Vec3 kOrigin(2'000, 50'000, 800);

std::string written(const SceneView& scene) {
  const Scratch scratch;
  write_usda(scratch.path("scene.usda"), scene);
  return bytes_of(scratch.path("scene.usda"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

// What stands in brackets after `name = `, from `from` on.
std::string array_of(const std::string& text, const std::string& name, std::size_t from = 0) {
  const std::size_t at = text.find(name + " = [", from);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 4;
  return text.substr(begin, text.find(']', begin) - begin);
}

std::vector<double> numbers_of(const std::string& text) {
  static const std::regex number(R"(-?\d+(\.\d+)?(e[-+]?\d+)?)");
  std::vector<double> out;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i)
    out.push_back(std::stod(i->str()));
  return out;
}

TEST(Usda, HasEveryPartInItsPlace) {
  const TriangleMesh ground = test::hill(), water = test::pool();
  const InstanceTable stones = heap(30, kOrigin);
  const std::string text = written(
      {.stones = &stones, .ground = {&ground, kOrigin}, .water = {&water, kOrigin + Vec3(0.5)}});
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  EXPECT_NE(text.find("metersPerUnit = 1\n"), std::string::npos);
  EXPECT_NE(text.find("upAxis = \"Z\"\n"), std::string::npos);
  EXPECT_EQ(count_of(text, "def Mesh \"ground\""), 1u);
  EXPECT_EQ(count_of(text, "def Mesh \"water\""), 1u);
  EXPECT_EQ(count_of(text, "def PointInstancer \"stones\""), 1u);
  EXPECT_EQ(count_of(text, "def Mesh \"stone_"), 3u);
  EXPECT_EQ(count_of(text, "def Material"), 3u);
  EXPECT_EQ(count_of(text, "xformOp:translate = (2000, 50000, 800)"), 1u);
  EXPECT_EQ(count_of(text, "xformOp:translate = (2000.5, 50000.5, 800.5)"), 1u);
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
}

TEST(Usda, MeshesKeepTheirNumbers) {
  const TriangleMesh ground = test::hill();
  const std::string text = written({.ground = {&ground, kOrigin}});
  const std::vector<double> points = numbers_of(array_of(text, "point3f[] points"));
  const std::vector<double> indices = numbers_of(array_of(text, "int[] faceVertexIndices"));
  ASSERT_EQ(points.size(), 3 * ground.positions.size());
  ASSERT_EQ(indices.size(), 3 * ground.triangles.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(static_cast<float>(points[i]), ground.positions[i / 3][static_cast<int>(i % 3)]);
  for (std::size_t i = 0; i < indices.size(); ++i)
    EXPECT_EQ(indices[i], ground.triangles[i / 3][static_cast<int>(i % 3)]);
  EXPECT_EQ(numbers_of(array_of(text, "int[] faceVertexCounts")),
            std::vector<double>(ground.triangles.size(), 3));
}

TEST(Usda, GroundTellsTheMaterialsThatItShows) {
  const TriangleMesh ground = test::hill();
  const std::string text = written({.ground = {&ground}});
  const std::vector<double> sand = numbers_of(array_of(text, "float[] primvars:sand"));
  ASSERT_EQ(sand.size(), ground.shares.size());
  for (std::size_t i = 0; i < sand.size(); ++i)
    EXPECT_NEAR(sand[i], ground.shares[i][1] / 255.0, 1e-7);
  EXPECT_NE(text.find("primvars:bedrock"), std::string::npos);
  EXPECT_EQ(text.find("primvars:snow"), std::string::npos);
  EXPECT_EQ(numbers_of(array_of(text, "color3f[] primvars:displayColor")).size(),
            3 * ground.shares.size());
}

TEST(Usda, StonesAreWhereTheTableSays) {
  const InstanceTable stones = heap(200, kOrigin);
  const std::string text = written({.stones = &stones});
  const std::size_t translate = text.find("double3 xformOp:translate = ");
  ASSERT_NE(translate, std::string::npos);
  const std::vector<double> center =
      numbers_of(text.substr(translate + 28, text.find('\n', translate) - translate - 28));
  const std::vector<double> positions = numbers_of(array_of(text, "point3f[] positions")),
                            turns = numbers_of(array_of(text, "quath[] orientations")),
                            scales = numbers_of(array_of(text, "float3[] scales")),
                            prototypes = numbers_of(array_of(text, "int[] protoIndices"));
  ASSERT_EQ(positions.size(), 3u * 200);
  ASSERT_EQ(turns.size(), 4u * 200);
  ASSERT_EQ(scales.size(), 3u * 200);
  ASSERT_EQ(prototypes.size(), 200u);
  for (std::size_t i = 0; i < 200; ++i) {
    const Instance& expected = stones.instances[i];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(positions[3 * i + c] + center[c], expected.position[static_cast<int>(c)], 1e-6);
      EXPECT_FLOAT_EQ(static_cast<float>(scales[3 * i + c]), expected.scale);
    }
    const Quat turn(static_cast<float>(turns[4 * i]), static_cast<float>(turns[4 * i + 1]),
                    static_cast<float>(turns[4 * i + 2]), static_cast<float>(turns[4 * i + 3]));
    EXPECT_EQ(turn, expected.rotation);
    EXPECT_EQ(prototypes[i], expected.prototype);
  }
}

TEST(Usda, WhatAllStonesDoWithoutIsLeftOut) {
  InstanceTable stones = heap(20);
  for (Instance& stone : stones.instances)
    stone = {stone.position, {1, 0, 0, 0}, 1, stone.prototype};
  const std::string text = written({.stones = &stones});
  EXPECT_EQ(text.find("orientations"), std::string::npos);
  EXPECT_EQ(text.find("scales"), std::string::npos);
}

TEST(Usda, AnEmptySceneIsAFileToo) {
  EXPECT_EQ(count_of(written({}), "def Material"), 3u);
  const InstanceTable none;
  EXPECT_EQ(count_of(written({.stones = &none}), "PointInstancer"), 0u);
}

TEST(Usda, SameSceneSameBytesForAnyThreads) {
  const InstanceTable stones = heap(40);
  const std::string expected = written({.stones = &stones});
  const ThreadLimit one(1);
  EXPECT_EQ(written({.stones = &stones}), expected);
}

TEST(Usda, ACancelledJobLeavesNothing) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  Job job;
  job.cancel();
  EXPECT_THROW(write_usda(scratch.path("scene.usda"), {.stones = &stones}, 1, &job), Cancelled);
  EXPECT_EQ(scratch.file_count(), 0u);
}

}  // namespace
}  // namespace talus
