#include "talus/io/glb_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

namespace talus {
namespace {

constexpr double kShortMax = std::numeric_limits<std::int16_t>::max();
constexpr double kUnsignedShortMax = std::numeric_limits<std::uint16_t>::max();

std::int8_t signed_byte(float x) { return static_cast<std::int8_t>(std::lround(127 * x)); }

// Rows of the file begin at multiples of four bytes.
std::array<std::int16_t, 4> shorts(const Vec3f& p) {
  return {static_cast<std::int16_t>(p.x), static_cast<std::int16_t>(p.y),
          static_cast<std::int16_t>(p.z), 0};
}

std::array<std::int8_t, 4> bytes(const Vec3f& d) {
  return {signed_byte(d.x), signed_byte(d.y), signed_byte(d.z), 0};
}

std::array<std::uint16_t, 2> fractions(const glm::vec2& uv, double span) {
  const auto share = [&](float x) {
    return static_cast<std::uint16_t>(std::lround(kUnsignedShortMax * x / span));
  };
  return {share(uv.x), share(uv.y)};
}

template <class T, class Encode>
std::vector<std::byte> encoded(const std::vector<T>& values, Encode&& encode) {
  using Row = std::invoke_result_t<Encode, const T&>;
  std::vector<std::byte> rows(values.size() * sizeof(Row));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Row row = encode(values[i]);
    std::memcpy(rows.data() + i * sizeof(Row), &row, sizeof(Row));
  }
  return rows;
}

std::vector<VertexAttribute> float_attributes() {
  return {{"POSITION", "VEC3", kFloat, 12, false,
           [](const DressedMesh& mesh, const VertexPlace& place) {
             return encoded(mesh.mesh.positions, [&](const Vec3f& p) { return place.position(p); });
           }},
          {"NORMAL", "VEC3", kFloat, 12, false,
           [](const DressedMesh& mesh, const VertexPlace& place) {
             return encoded(mesh.mesh.normals, [&](const Vec3f& n) { return place.direction(n); });
           }},
          {"TEXCOORD_0", "VEC2", kFloat, 8, false, [](const DressedMesh& mesh, const VertexPlace&) {
             return encoded(mesh.texture_coordinates, std::identity());
           }}};
}

std::vector<VertexAttribute> quantized_attributes(const VertexFormat& format) {
  return {{"POSITION", "VEC3", kShort, 8, false,
           [=](const DressedMesh& mesh, const VertexPlace& place) {
             return encoded(mesh.mesh.positions, [&](const Vec3f& p) {
               return shorts(stored_position(place.position(p), format));
             });
           }},
          {"NORMAL", "VEC3", kByte, 4, true,
           [](const DressedMesh& mesh, const VertexPlace& place) {
             return encoded(mesh.mesh.normals,
                            [&](const Vec3f& n) { return bytes(place.direction(n)); });
           }},
          {"TEXCOORD_0", "VEC2", kUnsignedShort, 4, true,
           [=](const DressedMesh& mesh, const VertexPlace&) {
             return encoded(mesh.texture_coordinates, [&](const glm::vec2& uv) {
               return fractions(uv, format.texture_span);
             });
           }}};
}

}  // namespace

VertexFormat quantized_format(std::span<const DressedMesh> meshes) {
  double reach = 0, span = 1;
  for (const DressedMesh& mesh : meshes) {
    for (const Vec3f& p : mesh.mesh.positions)
      reach =
          std::max({reach, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    for (const glm::vec2& uv : mesh.texture_coordinates)
      span = std::max({span, double{uv.x}, double{uv.y}});
  }
  const double step = reach > 0 ? std::exp2(std::ceil(std::log2(reach / kShortMax))) : 1;
  return {.quantized = true, .position_step = step, .texture_span = std::ceil(span)};
}

Vec3f stored_position(const Vec3f& p, const VertexFormat& format) {
  return format.quantized ? Vec3f(glm::round(Vec3(p) / format.position_step)) : p;
}

Vec3f VertexPlace::position(const Vec3f& p) const {
  return instance ? y_up(Vec3f(world_from_local(*instance, p) - center)) : y_up(p);
}

Vec3f VertexPlace::direction(const Vec3f& d) const {
  return y_up(instance ? glm::normalize(instance->rotation * d) : d);
}

std::vector<VertexAttribute> vertex_attributes(const VertexFormat& format) {
  std::vector<VertexAttribute> out =
      format.quantized ? quantized_attributes(format) : float_attributes();
  out.push_back(
      {"COLOR_0", "VEC4", kUnsignedByte, 4, true, [](const DressedMesh& mesh, const VertexPlace&) {
         return encoded(mesh.colors, std::identity());
       }});
  return out;
}

}  // namespace talus
