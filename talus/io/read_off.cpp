#include <fmt/format.h>

#include "talus/io/mesh_formats.h"
#include "talus/io/text_reader.h"

namespace talus {
namespace {

// A count from the header, which cannot exceed what the text has room for.
std::size_t checked_count(std::string_view what, std::int64_t count, std::size_t line_bytes,
                          std::size_t text_bytes, const TextReader& reader) {
  if (count < 0 || static_cast<std::uint64_t>(count) > text_bytes / line_bytes)
    throw reader.error(
        fmt::format("claims {} {}, but the file has {} bytes", count, what, text_bytes));
  return static_cast<std::size_t>(count);
}

}  // namespace

FileMesh read_off(std::string_view text, const std::string& path) {
  TextReader reader(text, path);

  // The keyword, then the counts on the same or the next line; the edge count is of no use.
  if (!reader.next_line()) throw reader.error("the file ends too early");
  const std::string_view keyword = reader.word();
  if (keyword != "OFF" && keyword != "COFF" && keyword != "NOFF" && keyword != "CNOFF")
    throw reader.error("not an OFF text: it should begin with OFF");
  const std::string_view first = reader.word_across_lines();
  if (first == "BINARY") throw reader.error("binary OFF is not read; save it as text or as PLY");
  const std::size_t vertices =
      checked_count("vertices", reader.to_integer(first), 6, text.size(), reader);
  const std::size_t faces = checked_count("faces", reader.integer(), 2, text.size(), reader);

  // What follows the three coordinates or the corners on a line is color and normal.
  FileMesh mesh;
  mesh.positions.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!reader.next_line())
      throw reader.error(fmt::format("the file ends after {} of {} vertices", i, vertices));
    const double x = reader.number(), y = reader.number(), z = reader.number();
    mesh.positions.emplace_back(x, y, z);
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    if (!reader.next_line())
      throw reader.error(fmt::format("the file ends after {} of {} faces", i, faces));
    const std::int64_t count = reader.integer();
    if (count < 0) throw reader.error(fmt::format("a face with {} corners", count));
    corners.clear();
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t index = reader.integer();
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        throw reader.error(
            fmt::format("face uses vertex {}, but there are {} (counted from 0)", index, vertices));
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    append_polygon(corners, mesh);
  }
  return mesh;
}

}  // namespace talus
