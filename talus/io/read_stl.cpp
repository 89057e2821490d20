#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "talus/base/error.h"
#include "talus/io/mesh_formats.h"
#include "talus/io/text_reader.h"

namespace talus {
namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of comment, then the count
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes of attributes

static_assert(std::endian::native == std::endian::little,
              "binary STL is read as it lies in memory");

std::uint64_t claimed_triangles(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
}

// Binary files may begin with "solid" too; then the size that the count claims decides.
bool is_text(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || bytes.substr(begin, 5) != "solid") return false;
  return bytes.size() < kHeaderBytes ||
         kHeaderBytes + kTriangleBytes * claimed_triangles(bytes) != bytes.size();
}

void append_triangle(FileMesh& mesh, const Vec3 (&corners)[3]) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), std::begin(corners), std::end(corners));
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

FileMesh read_binary(std::string_view bytes, const std::string& path) {
  if (bytes.size() < kHeaderBytes)
    throw input_error(fmt::format(
        "{}: no STL: {} bytes, a binary one has at least {}, a text one begins with \"solid\"",
        path, bytes.size(), kHeaderBytes));
  const std::uint64_t count = claimed_triangles(bytes);
  const std::uint64_t needed = kHeaderBytes + kTriangleBytes * count;
  if (needed > bytes.size())
    throw input_error(fmt::format("{}: claims {} triangles, which take {} bytes, but has {}", path,
                                  count, needed, bytes.size()));
  FileMesh mesh;
  mesh.positions.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    float corner[9];
    const std::size_t at = kHeaderBytes + kTriangleBytes * i + 3 * sizeof(float);
    std::memcpy(corner, bytes.data() + at, sizeof corner);
    append_triangle(mesh, {{corner[0], corner[1], corner[2]},
                           {corner[3], corner[4], corner[5]},
                           {corner[6], corner[7], corner[8]}});
  }
  return mesh;
}

FileMesh read_text(std::string_view text, const std::string& path) {
  FileMesh mesh;
  TextReader reader(text, path);
  Vec3 corners[3];
  std::size_t corner_count = 0;
  bool open_solid = false;
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "solid") {
      open_solid = true;
    } else if (keyword == "endsolid") {
      open_solid = false;
    } else if (keyword == "vertex") {
      if (corner_count == 3) throw reader.error("a facet has more than three vertices");
      const double x = reader.number(), y = reader.number(), z = reader.number();
      corners[corner_count++] = {x, y, z};
    } else if (keyword == "endfacet") {
      if (corner_count != 3)
        throw reader.error(fmt::format("a facet has {} vertices, not three", corner_count));
      append_triangle(mesh, corners);
      corner_count = 0;
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endloop") {
      throw reader.error("not a line of an STL text (solid, facet, outer loop, vertex, ...)");
    }
  }
  if (open_solid) throw reader.error("the file ends before endsolid");
  return mesh;
}

}  // namespace

FileMesh read_stl(std::string_view bytes, const std::string& path) {
  return is_text(bytes) ? read_text(bytes, path) : read_binary(bytes, path);
}

}  // namespace talus
