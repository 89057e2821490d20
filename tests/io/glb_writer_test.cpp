#include "talus/io/glb_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "io/scenes.h"
#include "io/scratch.h"
#include "talus/base/parallel.h"
#include "talus/io/dressed_mesh.h"
#include "talus/io/gltf_document.h"
#include "talus/io/gltf_nodes.h"
#include "talus/io/mesh_reader.h"
#include "talus/io/stone_material.h"
#include "talus/mesh/check.h"
#include "talus/terrain/material.h"

namespace talus {
namespace {

using test::area;
using test::bytes_of;
using test::heap;
using test::Scratch;

constexpr std::array kModes = {InstanceMode::gpu, InstanceMode::nodes, InstanceMode::flattened};

std::filesystem::path written(const Scratch& scratch, const InstanceTable& stones,
                              InstanceMode mode) {
  const auto path = scratch.path("scene.glb");
  write_glb(path, {.stones = &stones}, {.instances = mode});
  return path;
}

TEST(GlbWriter, EveryModeReadsBackAsTheSameScene) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  const TriangleMesh expected = flatten(stones, Vec3(0));
  for (const InstanceMode mode : kModes) {
    const TriangleMesh read = read_mesh(written(scratch, stones, mode)).mesh;
    EXPECT_EQ(read.triangles.size(), expected.triangles.size());
    const Box3 box = bounds(read), expected_box = bounds(expected);
    // The largest stone is half as large again as its mesh.
    const double half_step = mode == InstanceMode::gpu ? 1.5 * std::exp2(-15) : 0;
    EXPECT_NEAR(signed_volume(read), signed_volume(expected), 1e-4 + area(expected) * half_step);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.min[axis], expected_box.min[axis], 1e-5 + half_step);
      EXPECT_NEAR(box.max[axis], expected_box.max[axis], 1e-5 + half_step);
    }
    EXPECT_TRUE(check_mesh(read).closed());
    EXPECT_TRUE(check_mesh(read).oriented());
  }
}

// Parses what was written; the bytes must outlive the document.
struct Parsed {
  explicit Parsed(const std::filesystem::path& path)
      : bytes(bytes_of(path)), document(bytes, path) {}
  std::string bytes;
  GltfDocument document;
};

TEST(GlbWriter, PlacesFarStonesToAMicrometre) {
  const Scratch scratch;
  const InstanceTable stones = heap(30, {500'000, 5'000'000, 1500});
  for (const InstanceMode mode : {InstanceMode::gpu, InstanceMode::nodes}) {
    const Parsed parsed(written(scratch, stones, mode));
    std::size_t i = 0;
    for (const GltfNode& node : placed_nodes(parsed.document)) {
      if (!parsed.document.item("nodes", node.index).contains("mesh")) continue;
      for (const glm::dmat4& place : node_places(parsed.document, node)) {
        const Vec3 world = stones.instances[i++].position;
        EXPECT_LT(glm::distance(Vec3(place[3]), Vec3(world.x, world.z, -world.y)), 1e-6);
      }
    }
    EXPECT_EQ(i, stones.instances.size());
  }
}

TEST(GlbWriter, NamesThePartsAndSharesTheMeshes) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  const std::array<std::size_t, 3> nodes = {1 + 3 + 1, 1 + 40, 1 + 1}, meshes = {3, 3, 1};
  for (std::size_t m = 0; m < kModes.size(); ++m) {
    const Parsed parsed(written(scratch, stones, kModes[m]));
    EXPECT_EQ(parsed.document.size("nodes"), nodes[m]);
    EXPECT_EQ(parsed.document.size("meshes"), meshes[m]);
    EXPECT_EQ(parsed.document.item("nodes", 0)["name"], "stones");
    EXPECT_EQ(parsed.document.item("nodes", 1)["name"],
              kModes[m] == InstanceMode::flattened ? "stones/0" : "stones/0/0");
    EXPECT_EQ(parsed.document.root().contains("extensionsRequired"),
              kModes[m] == InstanceMode::gpu);
    EXPECT_EQ(parsed.document.item("materials", 0)["name"], "stone");
  }
}

// Ground, water and stones, far from the origin.
struct Landscape {
  TriangleMesh ground = test::hill();
  TriangleMesh water = test::pool();
  InstanceTable stones = heap(12, kOrigin);

  static constexpr Vec3 kOrigin{500'000, 5'000'000, 1500};
  SceneView view() const {
    return {.stones = &stones, .ground = {&ground, kOrigin}, .water = {&water, kOrigin}};
  }
};

TEST(GlbWriter, NamesGroundWaterAndStonesAndPutsThemInPlace) {
  const Scratch scratch;
  const Landscape scene;
  const GlbStats stats = write_glb(scratch.path("a.glb"), scene.view());
  EXPECT_EQ(stats.nodes, 2u + 1 + 1 + 3);
  EXPECT_EQ(stats.meshes, 2u + 3);
  const Parsed parsed(scratch.path("a.glb"));
  EXPECT_EQ(parsed.document.item("scenes", 0)["nodes"], nlohmann::json::array({0, 1, 2}));
  const Vec3 origin = Landscape::kOrigin;
  for (const auto& [index, name, mesh] :
       {std::tuple{0u, "ground", &scene.ground}, {1u, "water", &scene.water}}) {
    const nlohmann::json& node = parsed.document.item("nodes", index);
    EXPECT_EQ(node["name"], name);
    EXPECT_EQ(node["translation"], nlohmann::json::array({origin.x, origin.z, -origin.y}));
    const nlohmann::json& primitive = parsed.document.item("meshes", node["mesh"])["primitives"][0];
    const AccessorView positions = parsed.document.accessor(primitive["attributes"]["POSITION"]);
    ASSERT_EQ(positions.count, mesh->positions.size());
    for (std::size_t i = 0; i < positions.count; ++i) {
      const Vec3f p = mesh->positions[i];
      EXPECT_EQ(positions.vec3(i), Vec3(p.x, p.z, -p.y));
    }
    EXPECT_EQ(parsed.document.accessor(primitive["indices"]).count, 3 * mesh->triangles.size());
  }
  EXPECT_EQ(parsed.document.item("nodes", 2)["name"], "stones");
  EXPECT_EQ(parsed.document.item("materials", 1)["alphaMode"], "BLEND");
}

TEST(GlbWriter, GroundShowsItsMaterials) {
  const Scratch scratch;
  const Landscape scene;
  write_glb(scratch.path("a.glb"), scene.view());
  const Parsed parsed(scratch.path("a.glb"));
  const nlohmann::json& mesh = parsed.document.item("meshes", 0);
  EXPECT_EQ(mesh["extras"]["materials"],
            (nlohmann::json{"bedrock", "sand", "soil", "rocks", "water", "ice", "snow", "air"}));
  const nlohmann::json& attributes = mesh["primitives"][0]["attributes"];
  const AccessorView colors = parsed.document.accessor(attributes["COLOR_0"]);
  const AccessorView low = parsed.document.accessor(attributes["_MATERIALS_0"]);
  const AccessorView high = parsed.document.accessor(attributes["_MATERIALS_1"]);
  ASSERT_EQ(colors.count, scene.ground.positions.size());
  const Vec3 rock(material_info(Material::bedrock).color),
      sand(material_info(Material::sand).color);
  for (std::size_t i = 0; i < colors.count; ++i) {
    for (int m = 0; m < 4; ++m) {
      const auto k = static_cast<std::size_t>(m);
      EXPECT_NEAR(low.at(i, m), scene.ground.shares[i][k] / 255.0, 1e-12);
      EXPECT_NEAR(high.at(i, m), scene.ground.shares[i][k + 4] / 255.0, 1e-12);
    }
    const Vec3 expected = low.at(i, 0) * rock + low.at(i, 1) * sand;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(colors.at(i, c), expected[c], 0.5 / 255 + 1e-6);
    EXPECT_EQ(colors.at(i, 3), 1);
  }
}

TEST(GlbWriter, UnitQuaternions) {
  const Scratch scratch;
  const Parsed parsed(written(scratch, heap(40), InstanceMode::gpu));
  std::size_t instances = 0;
  for (std::size_t i = 1; i < parsed.document.size("nodes"); ++i) {
    const nlohmann::json* attributes =
        instancing_attributes(parsed.document, parsed.document.item("nodes", i));
    if (!attributes) continue;
    const AccessorView r = parsed.document.accessor((*attributes)["ROTATION"]);
    for (std::size_t k = 0; k < r.count; ++k) {
      double length = 0;
      for (int c = 0; c < 4; ++c) length += r.at(k, c) * r.at(k, c);
      EXPECT_NEAR(length, 1, 1e-6);
    }
    instances += r.count;
  }
  EXPECT_EQ(instances, 40u);
}

TEST(GlbWriter, DirectionsInOneByteStayWithinHalfADegree) {
  const Scratch scratch;
  const InstanceTable stones = heap(3);
  const Parsed parsed(written(scratch, stones, InstanceMode::gpu));
  EXPECT_EQ(parsed.document.root()["extensionsRequired"],
            (nlohmann::json{"KHR_mesh_quantization", "KHR_texture_transform",
                            "EXT_mesh_gpu_instancing"}));
  for (std::size_t m = 0; m < 3; ++m) {
    const DressedMesh dressed = dress(*stones.prototypes[m], 1, static_cast<std::uint32_t>(m));
    const nlohmann::json& attributes =
        parsed.document.item("meshes", m)["primitives"][0]["attributes"];
    const AccessorView normals = parsed.document.accessor(attributes["NORMAL"]);
    ASSERT_EQ(normals.count, dressed.mesh.normals.size());
    for (std::size_t i = 0; i < normals.count; ++i) {
      const Vec3 n(dressed.mesh.normals[i]);
      const double least = std::cos(glm::radians(0.5));
      EXPECT_GT(glm::dot(glm::normalize(normals.vec3(i)), Vec3(n.x, n.z, -n.y)), least);
    }
  }
}

// The metres that one unit of the file's meshes stands for.
double position_step(const Parsed& parsed) {
  return parsed.document.root()["scenes"][0]["extras"]["position_step"].get<double>();
}

TEST(GlbWriter, QuantizedPositionsAndTextureStayWithinHalfAStep) {
  const Scratch scratch;
  const InstanceTable stones = heap(3);
  const Parsed parsed(written(scratch, stones, InstanceMode::gpu));
  const double step = position_step(parsed);
  EXPECT_EQ(step, std::exp2(-14)) << "the cube's 1 m within 32 767 steps";
  const double span = parsed.document.item(
      "materials", 0)["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"][0];
  for (std::size_t m = 0; m < 3; ++m) {
    const DressedMesh dressed = dress(*stones.prototypes[m], 1, static_cast<std::uint32_t>(m));
    const nlohmann::json& attributes =
        parsed.document.item("meshes", m)["primitives"][0]["attributes"];
    const AccessorView positions = parsed.document.accessor(attributes["POSITION"]);
    const AccessorView coordinates = parsed.document.accessor(attributes["TEXCOORD_0"]);
    ASSERT_EQ(positions.count, dressed.mesh.positions.size());
    for (std::size_t i = 0; i < positions.count; ++i) {
      const Vec3 p(dressed.mesh.positions[i]), q = step * positions.vec3(i);
      for (const double miss : {q.x - p.x, q.y - p.z, q.z + p.y})
        EXPECT_LE(std::abs(miss), step / 2);
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(span * coordinates.at(i, c), dressed.texture_coordinates[i][c],
                    0.51 * span / 65'535);
    }
  }
}

TEST(GlbWriter, StonesThatMeetStillMeetWhenQuantized) {
  // Two halves of a ball whose border is jagged, cut apart and put whole cells away.
  const Scratch scratch;
  TriangleMesh low, high;
  for (std::size_t i = 0; i < 100; ++i) {
    const auto chance = [&](int what) {
      return uniform(hash(3, Purpose::texture, i, what), -1, 1);
    };
    const Vec3f p(Vec3(chance(0), chance(1), 0.25 + 0.2 * chance(2)));
    low.positions.push_back(p);
    high.positions.push_back(p - Vec3f(0, 0, 1));
  }
  for (std::uint32_t i = 2; i < 100; ++i) low.triangles.emplace_back(0, i - 1, i);
  high.triangles = low.triangles;
  InstanceTable stones{
      .prototypes = {std::make_shared<TriangleMesh>(low), std::make_shared<TriangleMesh>(high)}};
  stones.instances = {{.position = Vec3(5, 7, 2), .prototype = 0},
                      {.position = Vec3(5, 7, 3), .prototype = 1}};
  const TriangleMesh read = read_mesh(written(scratch, stones, InstanceMode::gpu)).mesh;
  ASSERT_EQ(read.triangles.size(), 2 * low.triangles.size());
  for (std::size_t t = 0; t < low.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(read.positions[read.triangles[t][c]],
                read.positions[read.triangles[t + low.triangles.size()][c]]);
}

TEST(GlbWriter, WhatStonesOfOneMeshShareStandsOnTheirNode) {
  const Scratch scratch;
  InstanceTable stones = heap(40);
  const Quat turn = stones.instances[0].rotation;
  for (Instance& instance : stones.instances) {
    instance.rotation = turn;
    instance.scale = 0.3f;
  }
  stones.instances.back().scale = 0.4f;
  const Parsed parsed(written(scratch, stones, InstanceMode::gpu));
  std::size_t i = 0;
  for (const GltfNode& placed : placed_nodes(parsed.document)) {
    const nlohmann::json& node = parsed.document.item("nodes", placed.index);
    const nlohmann::json* attributes = instancing_attributes(parsed.document, node);
    if (!attributes) continue;
    const bool alike = node["name"] != "stones/0/2";
    EXPECT_EQ(node.contains("rotation"), alike);
    EXPECT_EQ(attributes->size(), alike ? 1u : 3u);
    for (const glm::dmat4& place : node_places(parsed.document, placed)) {
      const Instance& expected = stones.instances[i++];
      for (const Vec3f& local : {Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)}) {
        const Vec3 world = world_from_local(expected, local);
        const Vec3 q = Vec3(local.x, local.z, -local.y) / position_step(parsed);
        EXPECT_LT(glm::distance(Vec3(place * glm::dvec4(q, 1)), Vec3(world.x, world.z, -world.y)),
                  1e-5);
      }
    }
  }
  EXPECT_EQ(i, 40u);
}

TEST(GlbWriter, ManyStonesComeInCellsOfNeighbors) {
  const Scratch scratch;
  const InstanceTable stones = heap(50'000);
  const Parsed parsed(written(scratch, stones, InstanceMode::gpu));
  const nlohmann::json& top = parsed.document.item("nodes", 0);
  EXPECT_EQ(top["name"], "stones");
  EXPECT_EQ(top["children"].size(), 8u);
  std::size_t instances = 0;
  for (const GltfNode& placed : placed_nodes(parsed.document)) {
    const nlohmann::json& node = parsed.document.item("nodes", placed.index);
    if (!node.contains("mesh")) continue;
    Box3 box;
    for (const glm::dmat4& place : node_places(parsed.document, placed)) {
      box.include(Vec3(place[3]));
      ++instances;
    }
    EXPECT_LE(box.longest_side(), 10) << "of a heap of 10 x 20 x 5 m";
  }
  EXPECT_EQ(instances, 50'000u);
}

TEST(GlbWriter, FlattensLargeScenesIntoChunks) {
  const Scratch scratch;
  // 25 000 pebbles of some 200 vertices pass one chunk's 4 million.
  InstanceTable stones = heap(25'000);
  stones.prototypes[1] = stones.prototypes[0];
  const auto path = scratch.path("scene.glb");
  const GlbStats stats =
      write_glb(path, {.stones = &stones}, {.instances = InstanceMode::flattened});
  EXPECT_EQ(stats.meshes, 2u);
  EXPECT_EQ(stats.triangles, triangle_count(stones));
  EXPECT_EQ(stats.bytes, std::filesystem::file_size(path));
  const Parsed parsed(path);
  for (std::size_t m = 0; m < 2; ++m) {
    const nlohmann::json& primitive = parsed.document.item("meshes", m)["primitives"][0];
    EXPECT_LE(parsed.document.accessor(primitive["attributes"]["POSITION"]).count, 4'000'000u);
    EXPECT_EQ(parsed.document.accessor(primitive["indices"]).component_type, 5125);
  }
}

TEST(GlbWriter, SameSceneSameBytesForAnyThreads) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  const std::string expected = bytes_of(written(scratch, stones, InstanceMode::gpu));
  const ThreadLimit one(1);
  EXPECT_EQ(bytes_of(written(scratch, stones, InstanceMode::gpu)), expected);
}

TEST(GlbWriter, AnEmptySceneIsAFileToo) {
  const Scratch scratch;
  for (const InstanceMode mode : kModes) {
    const Parsed parsed(written(scratch, {}, mode));
    EXPECT_EQ(parsed.document.size("nodes"), 0u);
    EXPECT_EQ(parsed.document.size("scenes"), 1u);
  }
}

TEST(GlbWriter, ACancelledJobLeavesNothing) {
  const Scratch scratch;
  const InstanceTable stones = heap(40);
  Job job;
  job.cancel();
  EXPECT_THROW(write_glb(scratch.path("scene.glb"), {.stones = &stones}, {}, &job), Cancelled);
  EXPECT_EQ(scratch.file_count(), 0u);
}

TEST(GlbWriter, RefusesMoreThanAGlbHolds) {
  // A million instances of one mesh of some 200 vertices, written out, pass 4 GiB.
  const Scratch scratch;
  InstanceTable stones{{heap(1).prototypes[0]}, std::vector<Instance>(1'000'000)};
  const test::Refusal refusal = test::refusal_of([&] {
    write_glb(scratch.path("a.glb"), {.stones = &stones}, {.instances = InstanceMode::flattened});
  });
  EXPECT_EQ(refusal.kind, ErrorKind::job);
  EXPECT_NE(refusal.line.find("a GLB holds at most 4"), std::string::npos) << refusal.line;
  EXPECT_EQ(scratch.file_count(), 0u);
}

TEST(Dress, KeepsTheSurfaceClosedAcrossTextureSeams) {
  const TriangleMesh stone = test::pebble({0.5f, 0.4f, 0.3f});
  const DressedMesh dressed = dress(stone, 1, 7);
  EXPECT_GT(dressed.mesh.positions.size(), stone.positions.size());
  EXPECT_EQ(dressed.mesh.triangles.size(), stone.triangles.size());
  EXPECT_EQ(dressed.mesh.normals.size(), dressed.mesh.positions.size());
  EXPECT_EQ(dressed.texture_coordinates.size(), dressed.mesh.positions.size());
  EXPECT_EQ(dressed.colors.size(), dressed.mesh.positions.size());
  EXPECT_TRUE(check_mesh(dressed.mesh).closed());
  EXPECT_EQ(signed_volume(dressed.mesh), signed_volume(stone));
}

TEST(Dress, NeverStretchesTheTextureMuch) {
  // Along an edge the texture runs at most as far as 1.3 repeats a unit; over a triangle it keeps
  // at least the share 1 / sqrt(3) of the area, less what calmer vertex normals cost.
  const DressedMesh dressed = dress(test::pebble({0.5f, 0.4f, 0.3f}), 1, 7);
  for (const Triangle& t : dressed.mesh.triangles) {
    const Vec3f ab = dressed.mesh.positions[t.y] - dressed.mesh.positions[t.x];
    const Vec3f ac = dressed.mesh.positions[t.z] - dressed.mesh.positions[t.x];
    const glm::vec2 uv = dressed.texture_coordinates[t.x];
    const glm::vec2 b = dressed.texture_coordinates[t.y] - uv,
                    c = dressed.texture_coordinates[t.z] - uv;
    EXPECT_LE(glm::length(b), 1.3001f * glm::length(ab));
    // The texture is never mirrored: v runs down, so that its area has the other sign.
    EXPECT_LT(b.x * c.y - b.y * c.x, -0.4f * 1.69f * glm::length(glm::cross(ab, ac)));
  }
}

TEST(Dress, TextureBeginsInItsFirstRepeat) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    glm::vec2 least(10);
    for (const glm::vec2& uv : dress(test::unit_cube(), 1, k).texture_coordinates)
      least = glm::min(least, uv);
    for (const float x : {least.x, least.y}) {
      EXPECT_GE(x, 0);
      EXPECT_LT(x, 1);
    }
  }
}

TEST(Dress, TintsStonesDifferently) {
  std::set<std::array<std::uint8_t, 4>> tints;
  for (std::uint32_t k = 0; k < 50; ++k) tints.insert(dress(test::unit_cube(), 1, k).colors[0]);
  EXPECT_GT(tints.size(), 40u);
}

TEST(StoneTextures, TileWithoutASeam) {
  // The step across the edge is no larger than steps inside.
  const StoneTextures textures = make_stone_textures(1);
  const auto step = [](const Image& image, int x0, int x1) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      sum += std::abs(image.pixels[static_cast<std::size_t>(3 * (y * image.width + x0))] -
                      image.pixels[static_cast<std::size_t>(3 * (y * image.width + x1))]);
    return sum / image.height;
  };
  for (const Image* image :
       {&textures.base_color, &textures.normal, &textures.occlusion_roughness}) {
    ASSERT_EQ(image->width, 512);
    ASSERT_EQ(image->height, 512);
    double inside = 0;
    for (int x = 0; x < 511; ++x) inside = std::max(inside, step(*image, x, x + 1));
    EXPECT_GT(inside, 0);
    EXPECT_LE(step(*image, 511, 0), inside);
  }
}

TEST(StoneTextures, NormalsPointOutOfTheSurface) {
  const Image normal = make_stone_textures(1).normal;
  for (std::size_t i = 0; i < normal.pixels.size(); i += 3) {
    const Vec3 n = Vec3(normal.pixels[i], normal.pixels[i + 1], normal.pixels[i + 2]) / 127.5 - 1.0;
    EXPECT_NEAR(glm::length(n), 1, 0.02);
    EXPECT_GT(n.z, 0.2);
  }
}

}  // namespace
}  // namespace talus
