#include <fmt/format.h>

#include "talus/io/mesh_formats.h"
#include "talus/io/text_reader.h"

namespace talus {
namespace {

// The vertex of a corner "v", "v/vt", "v//vn" or "v/vt/vn"; negative counts back from the last one
// defined so far.
std::uint32_t vertex_of(std::string_view corner, std::size_t count, const TextReader& reader) {
  const std::int64_t given = reader.to_integer(corner.substr(0, corner.find('/')));
  const auto vertices = static_cast<std::int64_t>(count);
  const std::int64_t index = given < 0 ? given + vertices : given - 1;
  if (index < 0 || index >= vertices)
    throw reader.error(fmt::format(
        "face uses vertex {}, but {} are defined before it (counted from 1)", given, count));
  return static_cast<std::uint32_t>(index);
}

}  // namespace

FileMesh read_obj(std::string_view text, const std::string& path) {
  FileMesh mesh;
  TextReader reader(text, path);
  std::vector<std::uint32_t> corners;
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "v") {
      const double x = reader.number(), y = reader.number(), z = reader.number();
      mesh.positions.emplace_back(x, y, z);
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view corner = reader.word(); !corner.empty(); corner = reader.word())
        corners.push_back(vertex_of(corner, mesh.positions.size(), reader));
      append_polygon(corners, mesh);
    } else if (keyword == "o") {
      mesh.objects.push_back({std::string(reader.word()), mesh.triangles.size()});
    } else if (keyword == "l" || keyword == "p") {
      ++mesh.dropped;
    }
  }
  return mesh;
}

}  // namespace talus
