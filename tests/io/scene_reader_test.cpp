#include "talus/io/scene_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "io/scenes.h"
#include "io/scratch.h"
#include "talus/base/error.h"
#include "talus/io/glb_writer.h"

namespace talus {
namespace {

using test::area;
using test::bytes_of;
using test::heap;
using test::hill;
using test::Scratch;

constexpr std::array kModes = {InstanceMode::gpu, InstanceMode::nodes};

std::filesystem::path written(const Scratch& scratch, const SceneView& scene, InstanceMode mode) {
  const auto path = scratch.path("scene.glb");
  write_glb(path, scene, {.instances = mode});
  return path;
}

void save(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Replaces text by text of the same length.
void replace(std::string& bytes, const std::string& from, const std::string& to) {
  ASSERT_EQ(from.size(), to.size());
  const std::size_t at = bytes.find(from);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, from.size(), to);
}

TEST(SceneReader, GroundComesBackToTheBit) {
  const Scratch scratch;
  const TriangleMesh ground = hill();
  const Vec3 origin(485'200.123456789, -6'818'800.25, 1'000.5);
  const auto scene = read_scene(written(scratch, {.ground = {&ground, origin}}, InstanceMode::gpu));
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->ground.positions, ground.positions);
  EXPECT_EQ(scene->ground.normals, ground.normals);
  EXPECT_EQ(scene->ground.triangles, ground.triangles);
  EXPECT_EQ(scene->ground.shares, ground.shares);
  EXPECT_EQ(scene->ground_origin, origin);
  EXPECT_TRUE(scene->stones.instances.empty());
  EXPECT_TRUE(scene->water.positions.empty());
}

TEST(SceneReader, WaterComesBackToTheBit) {
  const Scratch scratch;
  const TriangleMesh water = hill();
  const auto scene =
      read_scene(written(scratch, {.water = {&water, Vec3(1, 2, 3)}}, InstanceMode::nodes));
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->water.positions, water.positions);
  EXPECT_EQ(scene->water_origin, Vec3(1, 2, 3));
  EXPECT_TRUE(scene->ground.positions.empty());
}

TEST(SceneReader, StonesComeBackInTheirPlaces) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  for (const InstanceMode mode : kModes) {
    const auto scene = read_scene(written(scratch, {.stones = &stones}, mode));
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->stones.prototypes.size(), stones.prototypes.size());
    ASSERT_EQ(scene->stones.instances.size(), stones.instances.size());
    for (std::size_t i = 0; i < stones.instances.size(); ++i) {
      const Instance& read = scene->stones.instances[i];
      const Instance& expected = stones.instances[i];
      EXPECT_EQ(read.prototype, expected.prototype);
      for (const Vec3f& local : {Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)})
        EXPECT_LT(glm::distance(world_from_local(read, local), world_from_local(expected, local)),
                  1e-5);
    }
  }
}

TEST(SceneReader, StonesComeBackAsTheSameSolids) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  const TriangleMesh expected = flatten(stones, Vec3(0));
  for (const InstanceMode mode : kModes) {
    const auto scene = read_scene(written(scratch, {.stones = &stones}, mode));
    ASSERT_TRUE(scene);
    // Quantized, vertices are off by half a step at most, of meshes half as large again.
    const double half_step = mode == InstanceMode::gpu ? 1.5 * std::exp2(-15) : 0;
    EXPECT_NEAR(signed_volume(flatten(scene->stones, Vec3(0))), signed_volume(expected),
                1e-4 + area(expected) * half_step);
    for (const auto& prototype : scene->stones.prototypes)
      EXPECT_EQ(prototype->normals.size(), prototype->positions.size());
  }
}

TEST(SceneReader, AnotherProgramsFileIsNoScene) {
  const Scratch scratch;
  const TriangleMesh ground = hill();
  const auto path = written(scratch, {.ground = {&ground}}, InstanceMode::gpu);
  std::string bytes = bytes_of(path);
  replace(bytes, "\"Talus\"", "\"other\"");
  save(path, bytes);
  EXPECT_FALSE(read_scene(path));
}

TEST(SceneReader, AttributesThatDoNotFitAreRefused) {
  const Scratch scratch;
  const TriangleMesh ground = hill();
  const auto path = written(scratch, {.ground = {&ground}}, InstanceMode::gpu);
  std::string bytes = bytes_of(path);
  replace(bytes, "\"_MATERIALS_1\":4", "\"_MATERIALS_1\":0");
  save(path, bytes);
  EXPECT_THROW(read_scene(path), Error);
}

TEST(SceneReader, FlattenedStonesAreNoSceneAnyMore) {
  const Scratch scratch;
  const InstanceTable stones = heap(5);
  EXPECT_FALSE(read_scene(written(scratch, {.stones = &stones}, InstanceMode::flattened)));
}

TEST(SceneReader, ThePlaneComesBack) {
  const Scratch scratch;
  const InstanceTable stones = heap(5);
  EXPECT_EQ(
      read_scene(written(scratch, {.stones = &stones, .plane = 0.125}, InstanceMode::gpu))->plane,
      0.125);
  EXPECT_EQ(read_scene(written(scratch, {.stones = &stones}, InstanceMode::gpu))->plane,
            std::nullopt);
}

// A scene as text, with one node that shows one mesh.
std::string scene_text(const std::string& primitive) {
  return R"({"asset": {"version": "2.0", "generator": "Talus"}, "scene": 0,
    "scenes": [{"nodes": [0], "extras": {"instances": "gpu"}}],
    "nodes": [{"name": "ground", "mesh": 0}], "meshes": [{"primitives": [)" +
         primitive + "]}]}";
}

TEST(SceneReader, SceneWithoutTrianglesIsRefused) {
  const Scratch scratch;
  for (const char* primitive : {"", R"({"mode": 1})", R"({"attributes": {}})"}) {
    save(scratch.path("scene.gltf"), scene_text(primitive));
    EXPECT_THROW(read_scene(scratch.path("scene.gltf")), Error) << primitive;
  }
}

TEST(SceneReader, NumbersThatAreNotFiniteAreRefused) {
  const Scratch scratch;
  TriangleMesh ground = hill();
  ground.positions[7].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(read_scene(written(scratch, {.ground = {&ground}}, InstanceMode::gpu)), Error);
  ground = hill();
  ground.normals[7].y = -std::numeric_limits<float>::infinity();
  EXPECT_THROW(read_scene(written(scratch, {.ground = {&ground}}, InstanceMode::gpu)), Error);
}

// The file without its last bytes, its lengths made to fit.
std::string cut_binary(std::string bytes, std::size_t less) {
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, &bytes[at], 4);
    return number;
  };
  const auto put = [&](std::size_t at, std::size_t number) {
    const auto value = static_cast<std::uint32_t>(number);
    std::memcpy(&bytes[at], &value, 4);
  };
  const std::size_t binary = 20 + number_at(12);
  put(8, bytes.size() - less);
  put(binary, number_at(binary) - less);
  bytes.resize(bytes.size() - less);
  return bytes;
}

TEST(SceneReader, CutFilesAreRefused) {
  const Scratch scratch;
  const InstanceTable stones = heap(5);
  const auto path = written(scratch, {.stones = &stones}, InstanceMode::gpu);
  const std::string bytes = bytes_of(path);
  for (std::size_t part = 0; part < 64; ++part) {
    save(path, bytes.substr(0, bytes.size() * part / 64));
    EXPECT_THROW(read_scene(path), Error);
  }
}

TEST(SceneReader, DataThatEndEarlyAreRefused) {
  const Scratch scratch;
  const TriangleMesh ground = hill();
  const auto path = written(scratch, {.ground = {&ground}}, InstanceMode::gpu);
  const std::string bytes = bytes_of(path);
  for (std::size_t less = 4; less < 20'000; less += 996) {
    save(path, cut_binary(bytes, less));
    EXPECT_THROW(read_scene(path), Error);
  }
}

}  // namespace
}  // namespace talus
