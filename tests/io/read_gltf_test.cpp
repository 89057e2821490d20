#include <gtest/gtest.h>

#include "io/mesh_texts.h"
#include "io/scratch.h"
#include "talus/io/gltf_document.h"
#include "talus/io/mesh_reader.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

using test::Scratch;

TEST(ReadGltf, AppliesNodeTransforms) {
  const Scratch scratch;
  const auto path = scratch.file(
      "a.glb", test::cube_glb(R"("mesh": 0, "translation": [5, 6, 7], "scale": [1, 2, 3])"));
  const TriangleMesh mesh = read_mesh(path).mesh;
  // y up (5, 6, 7) is z up (5, -7, 6).
  EXPECT_EQ(bounds(mesh).min, Vec3(5, -10, 6));
  EXPECT_EQ(bounds(mesh).max, Vec3(6, -7, 8));
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 6);
}

TEST(ReadGltf, KeepsTheOutsideOfMirroredMeshes) {
  const Scratch scratch;
  const auto path = scratch.file("a.glb", test::cube_glb(R"("mesh": 0, "scale": [-1, 1, 1])"));
  EXPECT_DOUBLE_EQ(signed_volume(read_mesh(path).mesh), 1);
}

// The refusal of a cube whose node or document says more.
std::string refusal(const std::string& node, const std::string& more) {
  const Scratch scratch;
  const auto path = scratch.file("a.glb", test::cube_glb(node, more));
  return test::refusal_of([&] { read_mesh(path); }).line.substr(path.string().size());
}

TEST(ReadGltf, RefusesExtensionsThatChangeTheGeometry) {
  EXPECT_EQ(
      refusal(R"("mesh": 0)", R"("extensionsRequired": ["KHR_draco_mesh_compression"], )"),
      ": requires the extension KHR_draco_mesh_compression, which is not read; save it without");
  const Scratch scratch;
  EXPECT_NO_THROW(read_mesh(scratch.file(
      "a.glb",
      test::cube_glb(R"("mesh": 0)", R"("extensionsRequired": ["KHR_materials_unlit"], )"))));
}

TEST(ReadGltf, DrawsInstancesAndChecksTheirAttributes) {
  const Scratch scratch;
  const auto node = [](std::string_view attributes) {
    return fmt::format(
        R"("mesh": 0, "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{{}}}}}}})",
        attributes);
  };
  const auto path = scratch.file("a.glb", test::cube_glb(node(R"("TRANSLATION": 0)")));
  EXPECT_EQ(read_mesh(path).mesh.triangles.size(), 8u * 12);
  EXPECT_EQ(refusal(node(R"("TRANSLATION": 1)"), ""),
            ": EXT_mesh_gpu_instancing TRANSLATION should have 3 numbers for each instance");
  EXPECT_EQ(refusal(node(R"("TRANSLATION": 99)"), ""),
            ": refers to entry 99 of accessors, which has 2");
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

// Five corners of a strip or fan as quantized positions in a data URI.
std::string strip(int mode) {
  std::string bin;
  const int corners[5][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}};
  const int fan[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}};
  for (int i = 0; i < 5; ++i)
    for (int c = 0; c < 4; ++c)  // rows of three are padded to eight bytes
      test::put(bin, static_cast<std::int16_t>(c > 1 ? 0 : mode == 6 ? fan[i][c] : corners[i][c]));
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "extensionsRequired": ["KHR_mesh_quantization"],
"nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "mode": {}}},
{{"attributes": {{"POSITION": 0}}, "mode": 0}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5122, "count": 5, "type": "VEC3"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 40, "byteStride": 8}}],
"buffers": [{{"byteLength": 40, "uri": "data:application/octet-stream;base64,{}"}}]}})",
      mode, base64(bin));
}

TEST(ReadGltf, ReadsStripsAndFansOfQuantizedPositions) {
  const Scratch scratch;
  for (const int mode : {5, 6}) {
    const ReadMeshResult read = read_mesh(scratch.file("a.gltf", strip(mode)), {.up = Axis::z});
    ASSERT_EQ(read.mesh.triangles.size(), 3u);
    for (const Triangle& t : read.mesh.triangles) {
      const Vec3f &a = read.mesh.positions[t.x], &b = read.mesh.positions[t.y],
                  &c = read.mesh.positions[t.z];
      EXPECT_EQ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 1) << mode;
    }
    ASSERT_EQ(read.warnings.size(), 1u);  // the points of the second primitive
  }
}

TEST(ReadGltf, FindsBuffersBesideTheFile) {
  const Scratch scratch;
  std::string bin;
  for (const Vec3f& p : {Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}) test::put(bin, p);
  scratch.file("the buffer.bin", bin);
  const auto path = scratch.file("a.gltf",
                                 R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "the%20buffer.bin"}]})");
  EXPECT_EQ(read_mesh(path).mesh.triangles.size(), 1u);
}

TEST(ReadGltf, RefusesAnEmptyAccessorBeyondItsView) {
  const Scratch scratch;
  const std::string bytes = R"({"asset": {"version": "2.0"},
"accessors": [{"bufferView": 0, "byteOffset": 5000, "componentType": 5126, "count": 0,
               "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 3}],
"buffers": [{"byteLength": 3, "uri": "data:application/octet-stream;base64,AAAA"}]})";
  const GltfDocument document(bytes, "a.gltf");
  EXPECT_EQ(test::refusal_of([&] { document.accessor(0); }).kind, ErrorKind::input);
}

TEST(ReadGltf, SurvivesDeepNesting) {
  const Scratch scratch;
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 200'000; ++i) text += open;
    const auto path = scratch.file("a.gltf", text);
    EXPECT_EQ(test::refusal_of([&] { read_mesh(path); }).kind, ErrorKind::input);
  }
  std::string nested = R"({"asset": {"version": "2.0"}, "extras": )" + std::string(200'000, '[') +
                       std::string(200'000, ']') + "}";
  const auto path = scratch.file("b.gltf", nested);
  EXPECT_EQ(test::refusal_of([&] { read_mesh(path); }).kind, ErrorKind::input);
}

}  // namespace
}  // namespace talus
