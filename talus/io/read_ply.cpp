#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "talus/base/error.h"
#include "talus/io/mesh_formats.h"
#include "talus/io/text_reader.h"

namespace talus {
namespace {

enum class Encoding { text, little_endian, big_endian };
enum class Scalar { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string_view name;
  Scalar type;
  std::optional<Scalar> list_count;  // type of the count before a list; none for a single value
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t size = 0;  // bytes, the line end after end_header included
};

std::optional<Scalar> scalar_named(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Scalar>(i);
  return std::nullopt;
}

Property read_property(TextReader& reader) {
  const auto scalar = [&] {
    const std::string_view name = reader.word();
    const std::optional<Scalar> type = scalar_named(name);
    if (!type) throw reader.error("a property has no known type (float, int, uchar, ...)");
    return *type;
  };
  TextReader ahead = reader;
  Property property{};
  if (ahead.word() == "list") {
    reader = ahead;
    property.list_count = scalar();
  }
  property.type = scalar();
  property.name = reader.word();
  if (property.name.empty()) throw reader.error("a property has no name");
  return property;
}

Header read_header(std::string_view bytes, const std::string& path) {
  const std::size_t end = bytes.find("end_header");
  if (!bytes.starts_with("ply") || end == std::string_view::npos)
    throw input_error(fmt::format(
        "{}: no PLY: it should begin with \"ply\" and have a line \"end_header\"", path));
  Header header;
  header.size = std::min(bytes.find('\n', end), bytes.size() - 1) + 1;

  TextReader reader(bytes.substr(0, end), path);
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "format") {
      const std::string_view name = reader.word();
      if (name == "ascii")
        header.encoding = Encoding::text;
      else if (name == "binary_little_endian")
        header.encoding = Encoding::little_endian;
      else if (name == "binary_big_endian")
        header.encoding = Encoding::big_endian;
      else
        throw reader.error("format should be ascii, binary_little_endian or binary_big_endian");
    } else if (keyword == "element") {
      Element element{.name = reader.word()};
      const std::int64_t count = reader.integer();
      if (count < 0) throw reader.error(fmt::format("claims {} of an element", count));
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) throw reader.error("a property before the first element");
      header.elements.back().properties.push_back(read_property(reader));
    } else if (keyword != "ply" && keyword != "comment" && keyword != "obj_info") {
      throw reader.error("not a line of a PLY header (format, element, property, comment)");
    }
  }
  return header;
}

// Takes one value after another from the body.
class Body {
 public:
  Body(std::string_view bytes, Encoding encoding, const std::string& path)
      : bytes_(bytes), words_(bytes, path), encoding_(encoding), path_(path) {}

  double take(Scalar type) {
    if (encoding_ == Encoding::text) {
      const std::string_view word = words_.word_across_lines();
      if (type == Scalar::f32 || type == Scalar::f64) return words_.to_number(word);
      return static_cast<double>(words_.to_integer(word));
    }
    switch (type) {
      case Scalar::i8:
        return next<std::int8_t>();
      case Scalar::u8:
        return next<std::uint8_t>();
      case Scalar::i16:
        return next<std::int16_t>();
      case Scalar::u16:
        return next<std::uint16_t>();
      case Scalar::i32:
        return next<std::int32_t>();
      case Scalar::u32:
        return next<std::uint32_t>();
      case Scalar::f32:
        return next<float>();
      case Scalar::f64:
        return next<double>();
    }
    return 0;
  }

  // The values of a property: one, or a list of them.
  void take(const Property& property, std::vector<double>& values) {
    values.clear();
    const double count = property.list_count ? take(*property.list_count) : 1;
    if (!(count >= 0))
      throw input_error(fmt::format("{}: a list \"{}\" of {} values", path_, property.name, count));
    for (double i = 0; i < count; ++i) values.push_back(take(property.type));
  }

 private:
  static_assert(std::endian::native == std::endian::little);

  template <class T>
  double next() {
    if (bytes_.size() < sizeof(T))
      throw input_error(fmt::format("{}: the file ends too early", path_));
    std::array<char, sizeof(T)> raw;
    if (encoding_ == Encoding::little_endian)
      std::copy_n(bytes_.data(), sizeof(T), raw.begin());
    else
      std::reverse_copy(bytes_.data(), bytes_.data() + sizeof(T), raw.begin());
    bytes_.remove_prefix(sizeof(T));
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  std::string_view bytes_;
  TextReader words_;
  Encoding encoding_;
  const std::string& path_;
};

void check_counts(const Header& header, std::size_t body_bytes, const std::string& path) {
  // Every property takes at least one byte in any encoding.
  for (const Element& element : header.elements) {
    const std::size_t properties = std::max<std::size_t>(element.properties.size(), 1);
    if (element.count > body_bytes / properties)
      throw input_error(fmt::format("{}: claims {} of \"{}\", but only {} bytes follow the header",
                                    path, element.count, element.name, body_bytes));
  }
}

void read_vertices(const Element& element, Body& body, FileMesh& mesh, const std::string& path) {
  std::array<std::size_t, 3> at{};
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(),
                     [&](const Property& p) { return p.name == kAxes[axis] && !p.list_count; });
    if (found == element.properties.end())
      throw input_error(fmt::format("{}: vertices have no property {}", path, kAxes[axis]));
    at[axis] = static_cast<std::size_t>(found - element.properties.begin());
  }
  mesh.positions.reserve(element.count);
  std::vector<double> values, row(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      body.take(element.properties[k], values);
      row[k] = values.empty() ? 0 : values[0];
    }
    mesh.positions.emplace_back(row[at[0]], row[at[1]], row[at[2]]);
  }
}

void read_faces(const Element& element, Body& body, FileMesh& mesh, const std::string& path) {
  std::vector<double> values;
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      body.take(property, values);
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      corners.clear();
      for (const double index : values) {
        if (!(index >= 0 && index < static_cast<double>(mesh.positions.size())))
          throw input_error(fmt::format("{}: face {} uses vertex {}, but there are {}", path, i,
                                        index, mesh.positions.size()));
        corners.push_back(static_cast<std::uint32_t>(index));
      }
      append_polygon(corners, mesh);
    }
}

}  // namespace

FileMesh read_ply(std::string_view bytes, const std::string& path) {
  const Header header = read_header(bytes, path);
  check_counts(header, bytes.size() - header.size, path);
  FileMesh mesh;
  Body body(bytes.substr(header.size), header.encoding, path);
  std::vector<double> ignored;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, body, mesh, path);
    } else if (element.name == "face") {
      read_faces(element, body, mesh, path);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i)
        for (const Property& property : element.properties) body.take(property, ignored);
    }
  }
  return mesh;
}

}  // namespace talus
