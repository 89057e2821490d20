#include "talus/io/mesh_writer.h"

#include <gtest/gtest.h>

#include <cstring>

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
