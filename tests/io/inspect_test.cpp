#include "talus/io/inspect.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/mesh_texts.h"
#include "io/scenes.h"
#include "io/scratch.h"
#include "talus/io/glb_writer.h"
#include "talus/io/gltf_document.h"
#include "talus/io/gltf_nodes.h"
#include "talus/io/mesh_writer.h"
#include "test_data.h"

namespace talus {
namespace {

using test::heap;
using test::Scratch;

TEST(Inspect, TellsAMeshsSoundness) {
  const Scratch scratch;
  const auto path = scratch.file("cube.obj", test::cube_obj());
  const Inspection found = inspect(path);
  ASSERT_TRUE(found.mesh);
  EXPECT_EQ(found.bytes, std::filesystem::file_size(path));
  EXPECT_EQ(found.mesh->check.triangles, 12u);
  EXPECT_TRUE(found.mesh->check.closed());
  EXPECT_TRUE(found.mesh->check.manifold());
  EXPECT_TRUE(found.mesh->check.oriented());
  EXPECT_DOUBLE_EQ(found.mesh->volume.value(), 1);
  EXPECT_EQ(found.mesh->bounds.size(), Vec3(1));
  EXPECT_TRUE(found.parts.empty());
  EXPECT_FALSE(found.tiles);
}

TEST(Inspect, CountsTheStonesOfOurScenes) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  for (const InstanceMode mode : {InstanceMode::gpu, InstanceMode::nodes}) {
    write_glb(scratch.path("a.glb"), {.stones = &stones}, {.instances = mode});
    const Inspection found = inspect(scratch.path("a.glb"));
    ASSERT_EQ(found.parts.size(), 1u);
    EXPECT_EQ(found.parts[0].name, "stones");
    EXPECT_EQ(found.parts[0].instances, 40u);
    EXPECT_EQ(found.parts[0].unique, 3u);
    EXPECT_EQ(found.parts[0].triangles, triangle_count(stones));
    EXPECT_TRUE(found.parts[0].check.closed());
    EXPECT_TRUE(found.parts[0].check.oriented());
    EXPECT_FALSE(found.mesh);
    EXPECT_EQ(found.instancing.has_value(), mode == InstanceMode::gpu);
  }
}

TEST(Inspect, TellsGroundWaterAndStonesApart) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  const TriangleMesh ground = test::hill(), water = test::pool();
  write_glb(scratch.path("a.glb"),
            {.stones = &stones, .ground = {&ground}, .water = {&water, {0, 0, 500'000}}});
  const Inspection found = inspect(scratch.path("a.glb"));
  ASSERT_EQ(found.parts.size(), 3u);
  EXPECT_EQ(found.parts[0].name, "ground");
  EXPECT_EQ(found.parts[0].triangles, ground.triangles.size());
  EXPECT_EQ(found.parts[0].check.boundary_edges, 4u * 40);
  EXPECT_TRUE(found.parts[0].check.oriented());
  EXPECT_EQ(found.parts[1].name, "water");
  EXPECT_EQ(found.parts[1].triangles, 2u);
  EXPECT_EQ(found.parts[2].name, "stones");
}

TEST(Inspect, JoinsAFlattenedScene) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  write_glb(scratch.path("a.glb"), {.stones = &stones}, {.instances = InstanceMode::flattened});
  const Inspection found = inspect(scratch.path("a.glb"));
  ASSERT_TRUE(found.mesh);
  EXPECT_EQ(found.mesh->check.triangles, triangle_count(stones));
  EXPECT_TRUE(found.mesh->check.closed());
}

TEST(Inspect, RefusesNodesOfMissingMeshes) {
  const Scratch scratch;
  const auto path = scratch.file("a.glb", test::cube_glb("\"mesh\": 7"));
  const test::Refusal refusal = test::refusal_of([&] { inspect(path); });
  EXPECT_EQ(refusal.kind, ErrorKind::input);
  EXPECT_EQ(refusal.line, path.string() + ": node 0 draws mesh 7 of 1");
}

TEST(Inspect, JudgesTheObjectsOfAnObjOneByOne) {
  const Scratch scratch;
  // Two stones that share a corner with the ground and two with each other.
  const TriangleMesh ground = test::hill(), water = test::pool();
  InstanceTable stones{.prototypes = {std::make_shared<TriangleMesh>(test::unit_cube())}};
  for (const double x : {0.0, 1.0, 5.0}) stones.instances.push_back({.position = Vec3(x, 0, 0)});
  write_obj(scratch.path("a.obj"), {.stones = &stones, .ground = {&ground}, .water = {&water}});
  const Inspection found = inspect(scratch.path("a.obj"));
  ASSERT_EQ(found.parts.size(), 3u);
  EXPECT_EQ(found.parts[0].name, "ground");
  EXPECT_EQ(found.parts[0].check.boundary_edges, 4u * 40);
  EXPECT_TRUE(found.parts[0].check.manifold());
  EXPECT_EQ(found.parts[1].name, "water");
  EXPECT_EQ(found.parts[2].name, "stones");
  EXPECT_EQ(found.parts[2].instances, 3u);
  EXPECT_EQ(found.parts[2].triangles, 3u * 12);
  EXPECT_TRUE(found.parts[2].check.closed());
  EXPECT_TRUE(found.parts[2].check.manifold()) << "cubes that touch are cubes still";
  ASSERT_TRUE(found.mesh);
  EXPECT_FALSE(found.mesh->check.manifold());
}

TEST(Inspect, AnOpenSurfaceHasNoVolume) {
  const Scratch scratch;
  const TriangleMesh ground = test::hill();
  write_ply(scratch.path("a.ply"), {.ground = {&ground}});
  const Inspection found = inspect(scratch.path("a.ply"));
  ASSERT_TRUE(found.mesh);
  EXPECT_FALSE(found.mesh->volume);
  EXPECT_EQ(found.mesh->check.unbalanced_edges, found.mesh->check.boundary_edges);
}

TEST(Inspect, TellsPartsOfOneNameApart) {
  const Scratch scratch;
  std::string bin;
  for (const Vec3f& p : {Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}) test::put(bin, p);
  scratch.file("a.bin", bin);
  // Extensions are read in any case.
  const Inspection found = inspect(scratch.file("a.GLTF", R"({"asset": {"version": "2.0"},
"nodes": [{"name": "rock", "mesh": 0}, {"name": "rock", "mesh": 0}, {"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "a.bin"}]})"));
  ASSERT_EQ(found.parts.size(), 3u);
  EXPECT_EQ(found.parts[0].name, "rock");
  EXPECT_EQ(found.parts[1].name, "rock 2");
  EXPECT_EQ(found.parts[2].name, "?");
}

TEST(Inspect, SurvivesTheMalformedCorpus) {
  const std::filesystem::path corpus = std::filesystem::path(TALUS_TEST_DATA_DIR) / "malformed";
  NEEDS_TEST_DATA();
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
    if (!entry.is_regular_file()) continue;
    try {
      inspect(entry.path());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
      ++refused;
    }
  }
  EXPECT_GE(refused, 15u);
}

TEST(CheckInstancing, FindsOurScenesSound) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  write_glb(scratch.path("a.glb"), {.stones = &stones});
  const InstancingCheck check = check_instancing(scratch.path("a.glb"));
  EXPECT_EQ(check.instances, 40u);
  EXPECT_EQ(check.prototypes, 3u);
  EXPECT_TRUE(check.problems.empty()) << check.problems[0];
}

// What is found after `change` was made to the attribute of the first prototype.
template <class Change>
std::vector<std::string> problems_after(const char* attribute, Change&& change) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  write_glb(scratch.path("a.glb"), {.stones = &stones});
  std::string bytes = test::bytes_of(scratch.path("a.glb"));
  std::size_t at = 0;
  {
    const GltfDocument document(bytes, scratch.path("a.glb"));
    const nlohmann::json& attributes = *instancing_attributes(document, document.item("nodes", 1));
    at = static_cast<std::size_t>(document.accessor(attributes[attribute]).data - bytes.data());
  }
  change(bytes, at);
  return check_instancing(scratch.file("b.glb", bytes)).problems;
}

void put_float(std::string& bytes, std::size_t at, float value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

TEST(CheckInstancing, FindsWhatIsWrong) {
  auto found = problems_after("ROTATION",
                              [](std::string& bytes, std::size_t at) { put_float(bytes, at, 3); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "node 1: ROTATION has quaternions that are not of unit length");

  found = problems_after("TRANSLATION", [](std::string& bytes, std::size_t at) {
    put_float(bytes, at, std::numeric_limits<float>::infinity());
  });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "node 1: TRANSLATION has values that are not finite");

  // Texts of equal length keep the chunk sizes.
  found = problems_after("SCALE", [](std::string& bytes, std::size_t) {
    bytes.replace(bytes.find("\"extensionsUsed\""), 16, "\"extensionsFree\"");
  });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "EXT_mesh_gpu_instancing is not in extensionsUsed");
}

}  // namespace
}  // namespace talus
