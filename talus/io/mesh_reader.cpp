#include "talus/io/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "talus/base/error.h"
#include "talus/io/mesh_formats.h"
#include "talus/io/read_file.h"
#include "talus/mesh/check.h"

namespace talus {
namespace {

enum class Format { gltf, obj, ply, stl, off, other };

// By extension; a file without one by its first bytes.
Format format_of(const std::filesystem::path& path, std::string_view bytes) {
  const std::string extension = lower_extension(path);
  if (extension == ".gltf" || extension == ".glb") return Format::gltf;
  if (extension == ".obj") return Format::obj;
  if (extension == ".ply") return Format::ply;
  if (extension == ".stl") return Format::stl;
  if (extension == ".off") return Format::off;
  if (!extension.empty()) return Format::other;
  if (bytes.starts_with("glTF")) return Format::gltf;
  if (bytes.starts_with("ply")) return Format::ply;
  if (bytes.starts_with("solid")) return Format::stl;
  if (bytes.starts_with("OFF")) return Format::off;
  return Format::other;
}

FileMesh read_format(Format format, std::string_view bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  switch (format) {
    case Format::gltf:
      return read_gltf(bytes, path);
    case Format::obj:
      return read_obj(bytes, name);
    case Format::ply:
      return read_ply(bytes, name);
    case Format::stl:
      return read_stl(bytes, name);
    case Format::off:
      return read_off(bytes, name);
    case Format::other:
      break;
  }
  return read_with_assimp(bytes, path);
}

Axis up_axis(Format format) {
  return format == Format::ply || format == Format::stl || format == Format::off ? Axis::z
                                                                                 : Axis::y;
}

Vec3 z_up(const Vec3& p, Axis up) {
  switch (up) {
    case Axis::x:
      return {p.y, p.z, p.x};
    case Axis::y:
      return {p.x, -p.z, p.y};
    case Axis::z:
      break;
  }
  return p;
}

// A float keeps 24 bits: details finer than this share of the distance to the origin are lost.
constexpr double kFloatResolution = 0x1p-24;
constexpr double kResolutionWarned = 1e-4;  // of the longest side

// One vertex for each position in use.
void join_positions(TriangleMesh& mesh) {
  const std::vector<std::uint32_t> joined = joined_vertices(mesh);
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  std::vector<Vec3f> positions;
  for (Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = joined[t[c]];
      if (place[vertex] == kUnused) {
        place[vertex] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(mesh.positions[vertex]);
      }
      t[c] = place[vertex];
    }
  mesh.positions = std::move(positions);
}

void warn_if_coarse(const TriangleMesh& mesh, const std::string& name,
                    std::vector<std::string>& warnings) {
  const Box3 box = bounds(mesh);
  const Vec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double distance = std::max({farthest.x, farthest.y, farthest.z});
  const double step = distance * kFloatResolution;
  if (step > kResolutionWarned * box.longest_side())
    warnings.push_back(fmt::format(
        "{}: lies {:.4g} m from the origin and keeps only steps of {:.2g} m there; move it closer",
        name, distance, step));
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

ReadMeshResult read_mesh(const std::filesystem::path& path, const ReadMeshParams& params) {
  validate(params);
  const std::string name = path.string();
  const std::string bytes = read_file(path);
  if (bytes.empty()) throw input_error(fmt::format("{}: the file is empty", name));
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    throw input_error(fmt::format("{}: UTF-16 text; save it as UTF-8", name));

  const Format format = format_of(path, bytes);
  FileMesh file = read_format(format, bytes, path);
  if (file.triangles.empty())
    throw input_error(
        file.positions.empty()
            ? fmt::format("{}: no mesh: it has neither vertices nor triangles", name)
            : fmt::format("{}: no triangles, only {} vertices", name, file.positions.size()));
  if (file.positions.size() > std::numeric_limits<std::uint32_t>::max())
    throw input_error(
        fmt::format("{}: {} vertices are more than 2^32 - 1", name, file.positions.size()));

  ReadMeshResult result;
  result.mesh.triangles = std::move(file.triangles);
  result.objects = std::move(file.objects);
  result.mesh.positions.reserve(file.positions.size());
  const Axis up = params.up.value_or(up_axis(format));
  for (std::size_t i = 0; i < file.positions.size(); ++i) {
    const Vec3f p(z_up(file.positions[i], up) * params.scale);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw input_error(fmt::format("{}: vertex {} is at ({}, {}, {}), not finite", name, i,
                                    file.positions[i].x, file.positions[i].y, file.positions[i].z));
    result.mesh.positions.push_back(p);
  }
  join_positions(result.mesh);

  if (file.dropped > 0)
    result.warnings.push_back(
        fmt::format("{}: left out {} lines, points and faces of two corners", name, file.dropped));
  warn_if_coarse(result.mesh, name, result.warnings);
  return result;
}

}  // namespace talus
