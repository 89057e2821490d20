#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mesh_texts.h"
#include "io/scratch.h"
#include "talus/base/hash.h"
#include "talus/io/inspect.h"
#include "talus/io/mesh_reader.h"

namespace talus {
namespace {

// Reads what may be broken: either a sound mesh comes out or an input error, nothing else. Looking
// into the file is as safe.
bool reads(const std::filesystem::path& path) {
  try {
    inspect(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
  }
  try {
    const TriangleMesh mesh = read_mesh(path).mesh;
    for (const Triangle& t : mesh.triangles)
      for (int c = 0; c < 3; ++c) EXPECT_LT(t[c], mesh.positions.size());
    EXPECT_FALSE(mesh.triangles.empty());
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
    return false;
  }
}

// Files are slow to make: short ones are cut at every byte, long ones in some 200 places.
std::size_t step(const std::string& bytes) { return 1 + bytes.size() / 200; }

TEST(ReadMeshFuzz, TruncationsAreSurvived) {
  const test::Scratch scratch;
  for (const auto& [name, bytes] : test::cube_files())
    for (std::size_t size = 0; size < bytes.size(); size += step(bytes))
      reads(scratch.file("cut_" + name, bytes.substr(0, size)));
}

TEST(ReadMeshFuzz, ATruncatedBinaryFileIsRefused) {
  const test::Scratch scratch;
  for (const auto& [name, bytes] : test::cube_files()) {
    if (name.ends_with(".obj") || name == "cube_text.stl" || name == "cube.off" ||
        name == "cube_text.ply")
      continue;
    for (std::size_t size = 0; size < bytes.size(); size += step(bytes))
      EXPECT_FALSE(reads(scratch.file("cut_" + name, bytes.substr(0, size)))) << name << size;
  }
}

TEST(ReadMeshFuzz, ATruncatedTextThatCountsIsRefused) {
  // A cut within the last number or the line end cannot be seen.
  const test::Scratch scratch;
  for (const char* name : {"cube.off", "cube_text.ply", "cube_text.stl"}) {
    const std::string bytes = test::cube_files().at(name);
    for (std::size_t size = 0; size + 15 < bytes.size(); size += step(bytes))
      EXPECT_FALSE(reads(scratch.file(std::string("cut_") + name, bytes.substr(0, size))))
          << name << " " << size;
  }
}

RC_GTEST_PROP(ReadMeshFuzz, FlippedBytesAreSurvived, (std::uint32_t seed)) {
  const test::Scratch scratch;
  for (const auto& [name, bytes] : test::cube_files()) {
    std::string broken = bytes;
    const auto flips = 1 + hash(seed, Purpose::texture, 0) % 4;
    for (std::uint64_t i = 1; i <= flips; ++i)
      broken[hash(seed, Purpose::texture, i, 0) % broken.size()] =
          static_cast<char>(hash(seed, Purpose::texture, i, 1));
    reads(scratch.file("flipped_" + name, broken));
  }
}

// Nodes, meshes and accessors that contradict each other.
TEST(ReadMeshFuzz, AbsurdGltfIsRefused) {
  const test::Scratch scratch;
  const std::string whole = test::cube_glb();
  const std::pair<std::string_view, std::string_view> changes[] = {
      {"\"count\": 8", "\"count\": 9"},
      {"\"count\": 36", "\"count\": 4611686018427387904"},
      {"\"byteOffset\": 96", "\"byteOffset\": 18446744073709551615"},
      {"\"byteLength\": 96", "\"byteLength\": 99999"},
      {"\"componentType\": 5123", "\"componentType\": 5126"},
      {"\"bufferView\": 0", "\"bufferView\": 7"},
      {"\"indices\": 1", "\"indices\": -1"},
      {"\"POSITION\": 0", "\"POSITION\": 1"},
      {"\"mesh\": 0", "\"mesh\": 1"},
      {"\"scene\": 0", "\"scene\": \"hello\""},
      {"\"scene\": 0", "\"scene\": 3"},
      {"\"nodes\": [0]", "\"nodes\": [0, 0]"},
      {"\"primitives\": [", "\"primitives\": [3, "},
      {"{\"version\"", "{\"x\": \""}};
  for (const auto& [from, to] : changes) {
    // The JSON chunk's length changes with its text.
    std::string json = whole.substr(20, whole.find("BIN") - 24);
    ASSERT_NE(json.find(from), std::string::npos) << from;
    json.replace(json.find(from), from.size(), to);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    test::put(glb, std::uint32_t{2});
    test::put(glb, static_cast<std::uint32_t>(28 + json.size() + 168));
    test::put(glb, static_cast<std::uint32_t>(json.size()));
    glb += "JSON" + json + whole.substr(whole.find("BIN") - 4);
    EXPECT_FALSE(reads(scratch.file("a.glb", glb))) << from << " -> " << to;
  }
}

}  // namespace
}  // namespace talus
