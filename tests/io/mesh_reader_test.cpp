#include "talus/io/mesh_reader.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <optional>

#include "io/mesh_texts.h"
#include "io/scratch.h"
#include "mesh/shapes.h"
#include "talus/mesh/check.h"
#include "test_data.h"

namespace talus {
namespace {

using test::Refusal;
using test::refusal_of;
using test::Scratch;

// Every file of the test data and what it gives: triangles, or a piece of the line that refuses it.
struct Outcome {
  std::string_view file;
  std::size_t triangles;
  std::string_view refusal;
};

constexpr Outcome kOutcomes[] = {
    {"malformed/gltf/BoxWithInfinites/BoxWithInfinites.glb", 0, "not finite"},
    {"malformed/gltf/IndexOutOfRange/AllIndicesOutOfRange.bin", 0, "unknown mesh format \".bin\""},
    {"malformed/gltf/IndexOutOfRange/AllIndicesOutOfRange.gltf", 0,
     "a triangle uses vertex 65535, but its primitive has 24"},
    {"malformed/gltf/IndexOutOfRange/IndexOutOfRange.bin", 0, "unknown mesh format \".bin\""},
    {"malformed/gltf/IndexOutOfRange/IndexOutOfRange.gltf", 0,
     "a triangle uses vertex 255, but its primitive has 24"},
    {"malformed/gltf/MissingBin/BoxTextured.gltf", 0,
     "BoxTextured.gltf: needs a buffer beside it: "},
    {"malformed/gltf/RecursiveNodes/RecursiveNodes.gltf", 0, "its own ancestor"},
    {"malformed/gltf/SchemaFailures/CesiumLogoFlat.png", 0, "unknown mesh format \".png\""},
    {"malformed/gltf/SchemaFailures/sceneWrongType.gltf", 0, "needs a buffer beside it"},
    {"malformed/gltf/zero-sized-bin-chunk-issue-440.glb", 1, {}},
    {"malformed/obj/box_UTF16BE.obj", 0, "save it as UTF-8"},
    {"malformed/obj/concave_polygon.obj", 64, {}},
    {"malformed/obj/empty.obj", 0, "the file is empty"},
    {"malformed/obj/malformed.obj", 0, "line 23: face uses vertex 12, but 8 are defined"},
    {"malformed/obj/number_formats.obj", 0, "line 11: \"3.1+e2\" is not a number"},
    {"malformed/obj/point_cloud.obj", 0, "no triangles, only 3 vertices"},
    {"malformed/obj/testmixed.obj", 12, {}},
    {"malformed/off/OutOfMemory.off", 0, "line 2: claims 353535235358 vertices"},
    {"malformed/off/invalid.off", 0, "line 7: face uses vertex 20, but there are 3"},
    {"malformed/ply/crash-30d6d0f7.ply", 0, "no PLY"},
    {"malformed/ply/cube_binary_crlf_header.ply", 12, {}},
    {"malformed/ply/empty.ply", 0, "the file is empty"},
    {"malformed/ply/issue623.ply", 0, "is not a whole number"},
    {"malformed/stl/formatDetection_noext", 1, {}},
    {"malformed/stl/triangle_with_empty_solid.stl", 1, {}},
    {"mesh/angel_scan.ply", 35804, {}},
    {"mesh/building_garage.glb", 196, {}},
    {"mesh/building_small_a.glb", 452, {}},
    {"mesh/davos_block_1057k.ply", 1057040, {}},
    {"mesh/degenerate_offset1.obj", 4418, {}},
    {"mesh/hourglass_touching.obj", 40, {}},
    {"mesh/moebius_nonorientable.obj", 448, {}},
    {"mesh/nonmanifold_openscad.obj", 1442, {}},
    {"mesh/owl_scan.ply", 24407, {}},
    {"mesh/rock_A.glb", 248, {}},
    {"mesh/self_intersectA.obj", 17160, {}},
    {"mesh/sphere_with_hole.stl", 285, {}},
    {"mesh/spider_degenerate_binary.stl", 1368, {}},
    {"mesh/spot.obj", 5856, {}},
    {"mesh/spot_inverted.obj", 5856, {}},
    {"mesh/tunnel.glb", 1924, {}},
};

TEST(ReadMesh, EveryFileGivesWhatTheTableSays) {
  const std::filesystem::path data = TALUS_TEST_DATA_DIR;
  NEEDS_TEST_DATA();
  std::size_t files = 0;
  for (const char* folder : {"malformed", "mesh"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = std::filesystem::relative(entry.path(), data).string();
      const auto expected = std::find_if(std::begin(kOutcomes), std::end(kOutcomes),
                                         [&](const Outcome& o) { return o.file == name; });
      ASSERT_NE(expected, std::end(kOutcomes)) << name << " is not in the table";
      ++files;
      if (expected->refusal.empty()) {
        EXPECT_EQ(read_mesh(entry.path()).mesh.triangles.size(), expected->triangles) << name;
        continue;
      }
      const Refusal refusal = refusal_of([&] { read_mesh(entry.path()); });
      EXPECT_EQ(refusal.kind, ErrorKind::input) << name;
      EXPECT_NE(refusal.line.find(expected->refusal), std::string::npos) << refusal.line;
      EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << refusal.line;
    }
  EXPECT_EQ(files, std::size(kOutcomes));
}

// What `text` under `name` is refused with.
std::string refusal(std::string_view name, std::string_view text) {
  const Scratch scratch;
  const auto path = scratch.file(name, text);
  const Refusal found = refusal_of([&] { read_mesh(path); });
  EXPECT_EQ(found.kind, ErrorKind::input);
  EXPECT_TRUE(found.line.starts_with(path.string())) << found.line;
  return found.line.substr(path.string().size());
}

TEST(ReadMesh, SaysWhyAFileIsNoMesh) {
  EXPECT_EQ(refusal("a.obj", "a letter, not a mesh\n"),
            ": no mesh: it has neither vertices nor triangles");
  EXPECT_EQ(refusal("a.obj", ""), ": the file is empty");
  EXPECT_EQ(refusal("a.obj", "v 0 0\n"), ", line 1: the line ends too early");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 0 nan 0\nv 1 0 0\nf 1 2 3\n"),
            ": vertex 1 is at (0, nan, 0), not finite");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nf 0 1 1\n"),
            ", line 2: face uses vertex 0, but 1 are defined before it (counted from 1)");
  EXPECT_EQ(refusal("a.off", "a letter"), ", line 1: not an OFF text: it should begin with OFF");
  EXPECT_EQ(refusal("a.off", "OFF BINARY\n"),
            ", line 1: binary OFF is not read; save it as text or as PLY");
  EXPECT_EQ(refusal("a.off", "OFF\n3 1 0\n0.00 0.00 0.00\n"),
            ", line 3: the file ends after 1 of 3 vertices");
  EXPECT_EQ(refusal("a.off", "OFF\n-3 1 0\n"),
            ", line 2: claims -3 vertices, but the file has 11 bytes");
  EXPECT_EQ(refusal("a.stl", "a letter"),
            ": no STL: 8 bytes, a binary one has at least 84, a text one begins with \"solid\"");
  EXPECT_EQ(refusal("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
            ", line 4: the file ends before endsolid");
  EXPECT_EQ(refusal("a.stl", "solid a\nendsolid a\n"),
            ": no mesh: it has neither vertices nor triangles");
  EXPECT_EQ(refusal("a.ply", "a letter"),
            ": no PLY: it should begin with \"ply\" and have a line \"end_header\"");
  EXPECT_EQ(refusal("a.gltf", "a letter"), ": no glTF: its JSON is malformed or cut off");
  EXPECT_EQ(refusal("a.gltf", "{}"), ": no glTF 2.0: asset.version should be \"2.0\"");
  EXPECT_EQ(refusal("a.txt", "a letter"),
            ": unknown mesh format \".txt\"; glTF, GLB, OBJ, PLY, STL and OFF are read best");
  EXPECT_EQ(refusal("a.fbx", "a letter").substr(0, 18), ": no readable mesh");
}

TEST(ReadMesh, DoesNotBelieveAHeadersCounts) {
  std::string stl(84, '\0');
  stl[80] = stl[81] = stl[82] = stl[83] = '\xff';
  EXPECT_EQ(refusal("a.stl", stl),
            ": claims 4294967295 triangles, which take 214748364834 bytes, but has 84");
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 900000000000000000\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_EQ(refusal("a.ply", ply),
            ": claims 900000000000000000 of \"vertex\", but only 0 bytes follow the header");
  // A list whose length is claimed within the body.
  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
      "property list uint double x\nend_header\n\xff\xff\xff\xff........";
  EXPECT_EQ(refusal("a.ply", list), ": vertices have no property x");
  const std::string other =
      "ply\nformat binary_little_endian 1.0\nelement other 1\n"
      "property list uint double x\nend_header\n\xff\xff\xff\xff........";
  EXPECT_EQ(refusal("a.ply", other), ": the file ends too early");
}

TEST(ReadMesh, RefusesWhatIsNoFile) {
  const Scratch scratch;
  EXPECT_NE(refusal_of([&] { read_mesh(scratch.path("none.ply")); }).line.find("no such file"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { read_mesh(scratch.path(".")); }).line.find("it is a folder"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { read_mesh("/dev/zero"); }).line.find("not a regular file"),
            std::string::npos);
}

TEST(ReadMesh, EveryFormatReadsTheSameCube) {
  const Scratch scratch;
  for (const auto& [name, bytes] : test::cube_files()) {
    const ReadMeshResult result = read_mesh(scratch.file(name, bytes));
    EXPECT_EQ(result.mesh.triangles.size(), 12u) << name;
    EXPECT_EQ(result.mesh.positions.size(), 8u) << name;
    EXPECT_TRUE(check_mesh(result.mesh).closed()) << name;
    EXPECT_DOUBLE_EQ(signed_volume(result.mesh), 1) << name;
    EXPECT_TRUE(result.warnings.empty()) << name;
  }
}

// One long side tells which axis points up.
constexpr std::string_view kNeedle = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\nf 1 2 4\n";

TEST(ReadMesh, TurnsFilesUpright) {
  const Scratch scratch;
  const auto path = scratch.file("a.obj", kNeedle);
  const auto size = [&](std::optional<Axis> up) {
    return bounds(read_mesh(path, {.up = up}).mesh).size();
  };
  EXPECT_EQ(size(std::nullopt), Vec3(1, 3, 2));
  EXPECT_EQ(size(Axis::y), Vec3(1, 3, 2));
  EXPECT_EQ(size(Axis::z), Vec3(1, 2, 3));
  EXPECT_EQ(size(Axis::x), Vec3(2, 3, 1));
  // y up: the file's z comes towards the viewer, which is minus y.
  EXPECT_EQ(bounds(read_mesh(path).mesh).min, Vec3(0, -3, 0));
}

TEST(ReadMesh, KeepsTheOutsideOutForEveryAxis) {
  const Scratch scratch;
  const auto path = scratch.file("cube.obj", test::cube_files().at("cube.obj"));
  for (const Axis up : {Axis::x, Axis::y, Axis::z})
    EXPECT_DOUBLE_EQ(signed_volume(read_mesh(path, {.up = up}).mesh), 1);
}

TEST(ReadMesh, Scales) {
  const Scratch scratch;
  const auto path = scratch.file("a.obj", kNeedle);
  EXPECT_EQ(bounds(read_mesh(path, {.scale = 0.5}).mesh).size(), Vec3(0.5, 1.5, 1));
  EXPECT_EQ(refusal_of([&] { read_mesh(path, {.scale = 0}); }).kind, ErrorKind::usage);
}

TEST(ReadMesh, ReadsObjAsPeopleWriteIt) {
  const Scratch scratch;
  const auto path = scratch.file("a.obj",
                                 "# comment\r\nmtllib a.mtl\r\nv 0 0 0 1.0\r\nv +1. 0 0\r\n"
                                 "v 1 1e0 0 # corner\r\nv 0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\n"
                                 "f 1/1/1 2//1 \\\r\n 3/1 -1\r\nl 1 2\r\n");
  const ReadMeshResult result = read_mesh(path);
  EXPECT_EQ(result.mesh.triangles.size(), 2u);
  EXPECT_EQ(bounds(result.mesh).size(), Vec3(1, 0, 1));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("left out 1 lines"), std::string::npos);
}

TEST(ReadMesh, CutsConcavePolygonsWithinThem) {
  // An L of area 3; a fan from its first corner would cover the notch.
  const Scratch scratch;
  const auto path = scratch.file(
      "l.off", "OFF 6 1 0\n0 2 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n6 0 1 2 3 4 5 255 0 0\n");
  const TriangleMesh mesh = read_mesh(path).mesh;
  ASSERT_EQ(mesh.triangles.size(), 4u);
  float area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3f n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                               mesh.positions[t.z] - mesh.positions[t.x]);
    EXPECT_GT(n.z, 0);
    area += n.z / 2;
  }
  EXPECT_FLOAT_EQ(area, 3);
}

TEST(ReadMesh, WarnsWhereFloatsAreTooCoarse) {
  const Scratch scratch;
  const auto path = scratch.file("far.off",
                                 "OFF 3 1 0\n5000000 5000000 0\n5000001 5000000 0\n"
                                 "5000000 5000001 0\n3 0 1 2\n");
  const ReadMeshResult result = read_mesh(path);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("move it closer"), std::string::npos);
}

TEST(ReadMesh, LeavesOtherFormatsToAssimp) {
  const Scratch scratch;
  const TriangleMesh cube = test::unit_cube();
  aiScene scene;
  scene.mRootNode = new aiNode("cube");
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mNumMeshes = 1;
  scene.mMeshes = new aiMesh* [1] { new aiMesh };
  aiMesh& mesh = *scene.mMeshes[0];
  mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh.mNumVertices = static_cast<unsigned>(cube.positions.size());
  mesh.mVertices = new aiVector3D[cube.positions.size()];
  for (std::size_t i = 0; i < cube.positions.size(); ++i)
    mesh.mVertices[i] = {cube.positions[i].x, cube.positions[i].y, cube.positions[i].z};
  mesh.mNumFaces = static_cast<unsigned>(cube.triangles.size());
  mesh.mFaces = new aiFace[cube.triangles.size()];
  for (std::size_t i = 0; i < cube.triangles.size(); ++i) {
    mesh.mFaces[i].mNumIndices = 3;
    mesh.mFaces[i].mIndices =
        new unsigned[3]{cube.triangles[i].x, cube.triangles[i].y, cube.triangles[i].z};
  }
  for (const std::string format : {"collada", "3ds", "x"}) {
    const auto path = scratch.path("cube." + (format == "collada" ? "dae" : format));
    ASSERT_EQ(Assimp::Exporter().Export(&scene, format, path.string()), AI_SUCCESS) << format;
    const TriangleMesh read = read_mesh(path).mesh;
    EXPECT_TRUE(check_mesh(read).closed()) << format;
    EXPECT_NEAR(std::abs(signed_volume(read)), 1, 1e-5) << format;
  }
}

}  // namespace
}  // namespace talus
