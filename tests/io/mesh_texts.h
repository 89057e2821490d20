// One cube in every mesh format that is read by Talus itself.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <string>

#include "mesh/shapes.h"

namespace talus::test {

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
void put_reversed(std::string& bytes, T value) {
  std::string raw;
  put(raw, value);
  bytes.append(raw.rbegin(), raw.rend());
}

inline std::string cube_obj() {
  std::string out;
  for (const Vec3f& p : unit_cube().positions) out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : unit_cube().triangles)
    out += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return out;
}

inline std::string cube_off() {
  std::string out = "OFF\n# a comment\n8 12 18\n\n";
  for (const Vec3f& p : unit_cube().positions) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : unit_cube().triangles) out += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
  return out;
}

inline std::string ply_header(std::string_view format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property double z\nelement face 12\nproperty uchar flag\n"
      "property list uchar int vertex_indices\nend_header\n",
      format);
}

inline std::string cube_ply_text() {
  std::string out = ply_header("ascii");
  for (const Vec3f& p : unit_cube().positions) out += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : unit_cube().triangles)
    out += fmt::format("0 3 {} {} {}\n", t.x, t.y, t.z);
  return out;
}

inline std::string cube_ply_binary(bool big_endian) {
  std::string out = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian");
  const auto add = [&](auto value) { big_endian ? put_reversed(out, value) : put(out, value); };
  for (const Vec3f& p : unit_cube().positions) {
    add(p.x);
    add(p.y);
    add(static_cast<double>(p.z));
  }
  for (const Triangle& t : unit_cube().triangles) {
    add(std::uint8_t{7});
    add(std::uint8_t{3});
    for (int c = 0; c < 3; ++c) add(static_cast<std::int32_t>(t[c]));
  }
  return out;
}

inline std::string cube_stl_text() {
  const TriangleMesh cube = unit_cube();
  std::string out = "solid a cube\n";
  for (const Triangle& t : cube.triangles) {
    out += "facet normal 0 0 0\n outer loop\n";
    for (int c = 0; c < 3; ++c) {
      const Vec3f p = cube.positions[t[c]];
      out += fmt::format("  vertex {} {} {}\n", p.x, p.y, p.z);
    }
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid a cube\n";
}

inline std::string cube_stl_binary() {
  const TriangleMesh cube = unit_cube();
  std::string out = "solid, says the comment of a binary file";
  out.resize(80, ' ');
  put(out, std::uint32_t{12});
  for (const Triangle& t : cube.triangles) {
    put(out, Vec3f(0));
    for (int c = 0; c < 3; ++c) put(out, cube.positions[t[c]]);
    put(out, std::uint16_t{0});
  }
  return out;
}

// A GLB whose single node is given as JSON members, for example "\"mesh\": 0".
inline std::string cube_glb(const std::string& node = "\"mesh\": 0", const std::string& more = {}) {
  std::string bin;
  for (const Vec3f& p : unit_cube().positions) put(bin, p);
  for (const Triangle& t : unit_cube().triangles)
    for (int c = 0; c < 3; ++c) put(bin, static_cast<std::uint16_t>(t[c]));
  std::string json = fmt::format(
      R"({{"asset": {{"version": "2.0"}}, {}"scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{{}}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"}},
{{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 96}},
{{"buffer": 0, "byteOffset": 96, "byteLength": 72}}], "buffers": [{{"byteLength": 168}}]}})",
      more, node);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(28 + json.size() + bin.size()));
  put(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  put(out, static_cast<std::uint32_t>(bin.size()));
  return out + std::string("BIN\0", 4) + bin;
}

inline std::map<std::string, std::string> cube_files() {
  return {{"cube.obj", cube_obj()},
          {"cube.off", cube_off()},
          {"cube_text.ply", cube_ply_text()},
          {"cube_little.ply", cube_ply_binary(false)},
          {"cube_big.ply", cube_ply_binary(true)},
          {"cube_text.stl", cube_stl_text()},
          {"cube_binary.stl", cube_stl_binary()},
          {"cube.glb", cube_glb()}};
}

}  // namespace talus::test
