#include "talus/io/mesh_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

#include "io/scenes.h"
#include "io/scratch.h"
#include "talus/io/mesh_reader.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

using test::bytes_of;
using test::heap;
using test::Scratch;

void expect_same_scene(const TriangleMesh& read, const InstanceTable& stones, double tolerance) {
  const TriangleMesh expected = flatten(stones, Vec3(0));
  EXPECT_EQ(read.triangles.size(), expected.triangles.size());
  EXPECT_NEAR(signed_volume(read), signed_volume(expected), 100 * tolerance);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(bounds(read).min[axis], bounds(expected).min[axis], tolerance);
    EXPECT_NEAR(bounds(read).max[axis], bounds(expected).max[axis], tolerance);
  }
  EXPECT_TRUE(check_mesh(read).closed());
}

TEST(PlyWriter, ReadsBackAsTheSameScene) {
  const Scratch scratch;
  const InstanceTable stones = heap(20);
  write_ply(scratch.path("a.ply"), {.stones = &stones});
  expect_same_scene(read_mesh(scratch.path("a.ply")).mesh, stones, 1e-6);
}

TEST(PlyWriter, KeepsDoublesFarFromTheOrigin) {
  const Scratch scratch;
  const InstanceTable stones = heap(1, {5'000'000, 0, 0});
  write_ply(scratch.path("a.ply"), {.stones = &stones});
  const std::string bytes = bytes_of(scratch.path("a.ply"));
  double x;
  std::memcpy(&x, bytes.data() + bytes.find("end_header\n") + 11, sizeof x);
  EXPECT_EQ(x, world_from_local(stones.instances[0], stones.prototypes[0]->positions[0]).x);
}

TEST(ObjWriter, ReadsBackAsTheSameScene) {
  const Scratch scratch;
  const InstanceTable stones = heap(20);
  write_obj(scratch.path("a.obj"), {.stones = &stones});
  expect_same_scene(read_mesh(scratch.path("a.obj")).mesh, stones, 2e-6);
}

TEST(ObjWriter, NamesEveryStone) {
  const Scratch scratch;
  const InstanceTable stones = heap(6);
  write_obj(scratch.path("a.obj"), {.stones = &stones});
  const std::string text = bytes_of(scratch.path("a.obj"));
  for (const char* name : {"stones/0/0", "stones/0/1", "stones/1/0", "stones/2/1"})
    EXPECT_NE(text.find(std::string("o ") + name + "\n"), std::string::npos) << name;
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(MeshWriters, WriteGroundAndWaterToo) {
  const Scratch scratch;
  const TriangleMesh ground = test::hill(), water = test::pool();
  const InstanceTable stones = heap(5);
  const SceneView scene{
      .stones = &stones, .ground = {&ground, {0, 0, 7}}, .water = {&water, {0, 0, 9}}};
  write_ply(scratch.path("a.ply"), scene);
  write_obj(scratch.path("a.obj"), scene);
  for (const char* name : {"a.ply", "a.obj"}) {
    const TriangleMesh read = read_mesh(scratch.path(name)).mesh;
    EXPECT_EQ(read.triangles.size(),
              ground.triangles.size() + water.triangles.size() + triangle_count(stones))
        << name;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const Vec3f expected = ground.positions[ground.triangles[i][c]] + Vec3f(0, 0, 7);
        EXPECT_LT(glm::distance(read.positions[read.triangles[i][c]], expected), 1e-5f) << name;
      }
  }
}

TEST(PlyWriter, TellsColorsAndSharesOfEveryVertex) {
  const Scratch scratch;
  const TriangleMesh ground = test::hill(), water = test::pool();
  write_ply(scratch.path("a.ply"), {.ground = {&ground}, .water = {&water}});
  const std::string bytes = bytes_of(scratch.path("a.ply"));
  EXPECT_NE(bytes.find("property uchar blue\nproperty uchar bedrock\nproperty uchar sand\n"),
            std::string::npos);
  const std::size_t record = 24 + 12 + 3 + 8;
  const char* first = bytes.data() + bytes.find("end_header\n") + 11;
  for (std::size_t i = 0; i < ground.positions.size(); ++i) {
    MaterialShares shares;
    std::memcpy(&shares, first + i * record + 39, sizeof shares);
    EXPECT_EQ(shares, ground.shares[i]);
  }
  // Bedrock alone: linear 0.30 is 149 of 255 in sRGB.
  EXPECT_EQ(static_cast<std::uint8_t>(first[36]), 149);
  MaterialShares of_water;
  std::memcpy(&of_water, first + ground.positions.size() * record + 39, sizeof of_water);
  EXPECT_EQ(of_water[4], 255);
}

TEST(ObjWriter, ColorsTheGround) {
  const Scratch scratch;
  const TriangleMesh ground = test::hill();
  write_obj(scratch.path("a.obj"), {.ground = {&ground}});
  const std::string text = bytes_of(scratch.path("a.obj"));
  EXPECT_NE(text.find("o ground\nv 0.000000 0.000000 -0.000000 0.584 0.557 0.525\n"),
            std::string::npos)
      << text.substr(0, 200);
}

TEST(MeshWriters, CancelledJobsLeaveNothing) {
  const Scratch scratch;
  const InstanceTable stones = heap(6);
  Job job;
  job.cancel();
  EXPECT_THROW(write_ply(scratch.path("a.ply"), {.stones = &stones}, &job), Cancelled);
  EXPECT_THROW(write_obj(scratch.path("a.obj"), {.stones = &stones}, &job), Cancelled);
  EXPECT_EQ(scratch.file_count(), 0u);
}

}  // namespace
}  // namespace talus
