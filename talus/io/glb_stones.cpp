#include "talus/io/glb_stones.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "talus/base/parallel.h"
#include "talus/io/gltf_document.h"
#include "talus/io/png.h"
#include "talus/io/stone_material.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr std::uint64_t kChunkVertices = 4'000'000;

std::array<double, 4> rotation(const Instance& instance) {
  const glm::dquat q = glm::normalize(glm::dquat(instance.rotation));
  return {q.x, q.z, -q.y, q.w};
}

std::int8_t signed_byte(float x) { return static_cast<std::int8_t>(std::lround(127 * x)); }

Vec3f turned(const Instance* instance, const Vec3f& direction) {
  return y_up(instance ? glm::normalize(instance->rotation * direction) : direction);
}

}  // namespace

GlbStones::GlbStones(const InstanceTable& stones, const GlbParams& params, Job* job)
    : stones_(stones), params_(params), job_(job) {
  // Middle of the instances' positions, rounded so that it is short in the file.
  Box3 box;
  for (const Instance& instance : stones_.instances) box.include(instance.position);
  if (!box.empty()) center_ = glm::round(box.center());
  dress_prototypes();
  collect_meshes();
  measure_meshes();
  encode_textures();
}

void GlbStones::add_to(GlbFile& file, GlbStats& stats) {
  if (meshes_.empty()) return;
  const std::size_t first_mesh = file.size("meshes");
  add_meshes(file, add_material(file));
  add_nodes(file, first_mesh);
  for (const OutMesh& mesh : meshes_) {
    stats.vertices += mesh.vertices;
    stats.triangles += mesh.triangles;
  }
}

void GlbStones::dress_prototypes() {
  dressed_.resize(stones_.prototypes.size());
  parallel_for(dressed_.size(), [&](std::size_t k) {
    check_cancelled(job_);
    dressed_[k] = dress(*stones_.prototypes[k], params_.seed, static_cast<std::uint32_t>(k));
  });
}

void GlbStones::add_piece(const Piece& piece, bool new_mesh) {
  if (new_mesh) meshes_.push_back({.first_piece = pieces_.size()});
  pieces_.push_back(piece);
  const DressedMesh& dressed = dressed_[piece.prototype];
  OutMesh& mesh = meshes_.back();
  ++mesh.piece_count;
  mesh.vertices += dressed.mesh.positions.size();
  mesh.triangles += dressed.mesh.triangles.size();
}

void GlbStones::collect_meshes() {
  if (params_.instances != InstanceMode::flattened) {
    for (std::uint32_t k = 0; k < dressed_.size(); ++k) add_piece({k, nullptr}, true);
    return;
  }
  for (const Instance& instance : stones_.instances) {
    const std::uint64_t vertices = dressed_[instance.prototype].mesh.positions.size();
    const bool full = meshes_.empty() || meshes_.back().vertices + vertices > kChunkVertices;
    add_piece({instance.prototype, &instance}, full);
  }
}

template <class Body>
void GlbStones::for_pieces(const OutMesh& mesh, Body&& body) const {
  check_cancelled(job_);
  for (std::size_t i = 0; i < mesh.piece_count; ++i) {
    const Piece& piece = pieces_[mesh.first_piece + i];
    body(piece, dressed_[piece.prototype]);
  }
}

void GlbStones::measure_meshes() {
  parallel_for(meshes_.size(), [&](std::size_t m) {
    for_pieces(meshes_[m], [&](const Piece& piece, const DressedMesh& dressed) {
      for (const Vec3f& p : dressed.mesh.positions) meshes_[m].box.include(Vec3(placed(piece, p)));
    });
  });
}

void GlbStones::encode_textures() {
  if (meshes_.empty()) return;
  const StoneTextures textures = make_stone_textures(params_.seed);
  const std::array<const Image*, 3> images = {&textures.base_color, &textures.normal,
                                              &textures.occlusion_roughness};
  parallel_for(images.size(), [&](std::size_t i) { textures_[i] = encode_png(*images[i]); });
}

Vec3f GlbStones::placed(const Piece& piece, const Vec3f& p) const {
  if (!piece.instance) return y_up(p);
  return y_up(Vec3f(world_from_local(*piece.instance, p) - center_));
}

std::array<double, 3> GlbStones::translation(const Instance& instance) const {
  const Vec3 p = y_up(instance.position - center_);
  return {p.x, p.y, p.z};
}

std::size_t GlbStones::add_material(GlbFile& file) const {
  constexpr std::array<const char*, 3> kNames = {"stone base color", "stone normal",
                                                 "stone occlusion roughness"};
  const std::size_t sampler = file.add(
      "samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  std::array<std::size_t, 3> texture{};
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const std::vector<std::byte>& png = textures_[i];
    const std::size_t view = file.add_view(
        png.size(), 0, 0, [&png](AtomicFile& out) { out.write(png.data(), png.size()); });
    const std::size_t image =
        file.add("images", {{"name", kNames[i]}, {"mimeType", "image/png"}, {"bufferView", view}});
    texture[i] = file.add("textures", {{"source", image}, {"sampler", sampler}});
  }
  return file.add("materials", {{"name", "stone"},
                                {"pbrMetallicRoughness",
                                 {{"baseColorTexture", {{"index", texture[0]}}},
                                  {"metallicRoughnessTexture", {{"index", texture[2]}}},
                                  {"metallicFactor", 0}}},
                                {"normalTexture", {{"index", texture[1]}}},
                                {"occlusionTexture", {{"index", texture[2]}}}});
}

void GlbStones::add_meshes(GlbFile& file, std::size_t material) const {
  std::uint64_t vertices = 0, index_bytes = 0;
  for (const OutMesh& mesh : meshes_) {
    vertices += mesh.vertices;
    index_bytes += mesh.index_bytes_padded();
  }
  // One view for each attribute of all meshes, piece after piece.
  const auto add_view = [&](int stride, auto&& write_piece) {
    return file.add_view(static_cast<std::uint64_t>(stride) * vertices, kArrayBuffer, stride,
                         [this, write_piece](AtomicFile& out) {
                           for (const OutMesh& mesh : meshes_)
                             for_pieces(mesh, [&](const Piece& piece, const DressedMesh& dressed) {
                               write_piece(out, piece, dressed);
                             });
                         });
  };
  const std::size_t positions =
      add_view(12, [this](AtomicFile& out, const Piece& piece, const DressedMesh& dressed) {
        for (const Vec3f& p : dressed.mesh.positions) out.write_value(placed(piece, p));
      });
  // Whoever draws instances knows numbers of one byte too; the others get floats.
  const bool short_directions = params_.instances == InstanceMode::gpu;
  if (short_directions) file.require_extension("KHR_mesh_quantization");
  const auto write_direction = [short_directions](AtomicFile& out, const Vec3f& d) {
    if (short_directions)
      out.write_value(std::array{signed_byte(d.x), signed_byte(d.y), signed_byte(d.z)});
    else
      out.write_value(d);
  };
  const int direction_type = short_directions ? kByte : kFloat;
  const int normal_stride = short_directions ? 4 : 12, tangent_stride = short_directions ? 4 : 16;
  const std::size_t normals =
      add_view(normal_stride, [=](AtomicFile& out, const Piece& piece, const DressedMesh& dressed) {
        for (const Vec3f& n : dressed.mesh.normals) {
          write_direction(out, turned(piece.instance, n));
          if (short_directions) out.write_value(std::int8_t{0});
        }
      });
  const std::size_t tangents = add_view(
      tangent_stride, [=](AtomicFile& out, const Piece& piece, const DressedMesh& dressed) {
        for (const glm::vec4& t : dressed.tangents) {
          write_direction(out, turned(piece.instance, Vec3f(t)));
          if (short_directions)
            out.write_value(signed_byte(t.w));
          else
            out.write_value(t.w);
        }
      });
  const std::size_t coordinates =
      add_view(8, [](AtomicFile& out, const Piece&, const DressedMesh& dressed) {
        out.write(dressed.texture_coordinates.data(), 8 * dressed.texture_coordinates.size());
      });
  const std::size_t colors =
      add_view(4, [](AtomicFile& out, const Piece&, const DressedMesh& dressed) {
        out.write(dressed.colors.data(), 4 * dressed.colors.size());
      });
  const std::size_t indices =
      file.add_view(index_bytes, kElementArrayBuffer, 0, [this](AtomicFile& out) {
        for (const OutMesh& mesh : meshes_) write_indices(mesh, out);
      });

  std::uint64_t first_vertex = 0, first_index_byte = 0;
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const OutMesh& mesh = meshes_[m];
    const auto attribute = [&](std::size_t view, int stride, int type, const char* shape) {
      return file.add_accessor(view, static_cast<std::uint64_t>(stride) * first_vertex, type, shape,
                               mesh.vertices, type != kFloat);
    };
    const std::size_t position = attribute(positions, 12, kFloat, "VEC3");
    const Vec3f min(mesh.box.min), max(mesh.box.max);
    file.at("accessors", position)["min"] = {min.x, min.y, min.z};
    file.at("accessors", position)["max"] = {max.x, max.y, max.z};
    const json attributes = {
        {"POSITION", position},
        {"NORMAL", attribute(normals, normal_stride, direction_type, "VEC3")},
        {"TANGENT", attribute(tangents, tangent_stride, direction_type, "VEC4")},
        {"TEXCOORD_0", attribute(coordinates, 8, kFloat, "VEC2")},
        {"COLOR_0", attribute(colors, 4, kUnsignedByte, "VEC4")}};
    const int index_type = mesh.index_bytes() == 2 ? kUnsignedShort : kUnsignedInt;
    const std::size_t index =
        file.add_accessor(indices, first_index_byte, index_type, "SCALAR", 3 * mesh.triangles);
    const json primitive = {{"attributes", attributes}, {"indices", index}, {"material", material}};
    file.add("meshes",
             {{"name", fmt::format("stones/{}", m)}, {"primitives", json::array({primitive})}});
    first_vertex += mesh.vertices;
    first_index_byte += mesh.index_bytes_padded();
  }
}

void GlbStones::add_nodes(GlbFile& file, std::size_t first_mesh) const {
  const Vec3 center = y_up(center_);
  const std::size_t parent =
      file.add_part({{"name", "stones"}, {"translation", {center.x, center.y, center.z}}});
  if (params_.instances == InstanceMode::flattened) {
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      file.add("nodes", {{"name", fmt::format("stones/{}", m)}, {"mesh", first_mesh + m}});
  } else if (params_.instances == InstanceMode::nodes) {
    std::uint32_t in_run = 0;
    for (std::size_t i = 0; i < stones_.instances.size(); ++i) {
      const Instance& instance = stones_.instances[i];
      in_run = i > 0 && stones_.instances[i - 1].prototype == instance.prototype ? in_run + 1 : 0;
      file.add("nodes", {{"name", fmt::format("stones/{}/{}", instance.prototype, in_run)},
                         {"mesh", first_mesh + instance.prototype},
                         {"translation", translation(instance)},
                         {"rotation", rotation(instance)},
                         {"scale", {instance.scale, instance.scale, instance.scale}}});
    }
  } else {
    add_instances(file, first_mesh);
  }
  json& children = file.at("nodes", parent)["children"];
  for (std::size_t i = parent + 1; i < file.size("nodes"); ++i) children.push_back(i);
}

void GlbStones::add_instances(GlbFile& file, std::size_t first_mesh) const {
  file.require_extension(kInstancingExtension);
  const std::vector<Instance>& instances = stones_.instances;
  const std::size_t count = instances.size();
  const std::size_t translations = file.add_view(12 * count, 0, 0, [this](AtomicFile& out) {
    for (const Instance& instance : stones_.instances)
      for (const double x : translation(instance)) out.write_value(static_cast<float>(x));
  });
  const std::size_t rotations = file.add_view(16 * count, 0, 0, [this](AtomicFile& out) {
    for (const Instance& instance : stones_.instances)
      for (const double x : rotation(instance)) out.write_value(static_cast<float>(x));
  });
  const std::size_t scales = file.add_view(12 * count, 0, 0, [this](AtomicFile& out) {
    for (const Instance& instance : stones_.instances) out.write_value(Vec3f(instance.scale));
  });
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    const std::uint32_t prototype = instances[first].prototype;
    while (end < count && instances[end].prototype == prototype) ++end;
    const std::uint64_t n = end - first;
    const json attributes = {
        {"TRANSLATION", file.add_accessor(translations, 12 * first, kFloat, "VEC3", n)},
        {"ROTATION", file.add_accessor(rotations, 16 * first, kFloat, "VEC4", n)},
        {"SCALE", file.add_accessor(scales, 12 * first, kFloat, "VEC3", n)}};
    file.add("nodes", {{"name", fmt::format("stones/{}", prototype)},
                       {"mesh", first_mesh + prototype},
                       {"extensions", {{kInstancingExtension, {{"attributes", attributes}}}}}});
  }
}

void GlbStones::write_indices(const OutMesh& mesh, AtomicFile& file) const {
  std::uint32_t first = 0;
  for_pieces(mesh, [&](const Piece&, const DressedMesh& dressed) {
    for (const Triangle& t : dressed.mesh.triangles)
      for (int c = 0; c < 3; ++c) {
        if (mesh.index_bytes() == 2)
          file.write_value(static_cast<std::uint16_t>(t[c] + first));
        else
          file.write_value(t[c] + first);
      }
    first += static_cast<std::uint32_t>(dressed.mesh.positions.size());
  });
  pad(file);
}

}  // namespace talus
