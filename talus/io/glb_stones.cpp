#include "talus/io/glb_stones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "talus/base/parallel.h"
#include "talus/io/png.h"
#include "talus/io/stone_material.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr std::uint64_t kChunkVertices = 4'000'000;
constexpr std::size_t kBatchPieces = 256;

json list(const Vec3f& v) { return {v.x, v.y, v.z}; }

}  // namespace

GlbStones::GlbStones(const InstanceTable& stones, const GlbParams& params, Job* job)
    : stones_(stones), params_(params), job_(job) {
  // Middle of the instances' positions, rounded so that it is short in the file.
  Box3 box;
  for (const Instance& instance : stones_.instances) box.include(instance.position);
  if (!box.empty()) center_ = glm::round(box.center());
  dress_prototypes();
  // Whoever draws instances knows quantized numbers too; the others get floats.
  if (params_.instances == InstanceMode::gpu) format_ = quantized_format(dressed_);
  collect_meshes();
  measure_meshes();
  encode_textures();
}

void GlbStones::add_to(GlbFile& file, GlbStats& stats) {
  if (meshes_.empty()) return;
  const std::size_t first_mesh = file.size("meshes");
  if (format_.quantized) {
    file.require_extension("KHR_mesh_quantization");
    file.at("scenes", 0)["extras"]["position_step"] = format_.position_step;
  }
  add_meshes(file, add_material(file));
  const Vec3 center = y_up(center_);
  const std::size_t parent =
      file.add_part({{"name", "stones"}, {"translation", {center.x, center.y, center.z}}});
  const std::vector<std::size_t> children = add_nodes(file, first_mesh);
  file.at("nodes", parent)["children"] = children;
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

void GlbStones::add_piece(Piece piece, bool new_mesh) {
  if (new_mesh) meshes_.push_back({.first_piece = pieces_.size()});
  OutMesh& mesh = meshes_.back();
  piece.first_vertex = static_cast<std::uint32_t>(mesh.vertices);
  piece.mesh = meshes_.size() - 1;
  pieces_.push_back(piece);
  ++mesh.piece_count;
  mesh.vertices += dressed(piece).mesh.positions.size();
  mesh.triangles += dressed(piece).mesh.triangles.size();
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

void GlbStones::measure_meshes() {
  parallel_for(meshes_.size(), [&](std::size_t m) {
    OutMesh& mesh = meshes_[m];
    mesh.min = Vec3f(std::numeric_limits<float>::infinity());
    mesh.max = -mesh.min;
    for (std::size_t i = mesh.first_piece; i < mesh.first_piece + mesh.piece_count; ++i) {
      const VertexPlace place_of = place(pieces_[i]);
      for (const Vec3f& p : dressed(pieces_[i]).mesh.positions) {
        mesh.min = glm::min(mesh.min, place_of.position(p));
        mesh.max = glm::max(mesh.max, place_of.position(p));
      }
    }
  });
}

void GlbStones::encode_textures() {
  if (meshes_.empty()) return;
  const StoneTextures textures = make_stone_textures(params_.seed);
  const std::array<const Image*, 3> images = {&textures.base_color, &textures.normal,
                                              &textures.occlusion_roughness};
  parallel_for(images.size(), [&](std::size_t i) { textures_[i] = encode_png(*images[i]); });
}

std::size_t GlbStones::add_material(GlbFile& file) const {
  constexpr std::array<const char*, 3> kNames = {"stone base color", "stone normal",
                                                 "stone occlusion roughness"};
  constexpr const char* kTransform = "KHR_texture_transform";
  const std::size_t sampler = file.add(
      "samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  const double span = format_.texture_span;
  if (span != 1) file.require_extension(kTransform);
  std::array<json, 3> texture;
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const std::vector<std::byte>& png = textures_[i];
    const std::size_t view = file.add_view(
        png.size(), 0, 0, [&png](AtomicFile& out) { out.write(png.data(), png.size()); });
    const std::size_t image =
        file.add("images", {{"name", kNames[i]}, {"mimeType", "image/png"}, {"bufferView", view}});
    texture[i] = {{"index", file.add("textures", {{"source", image}, {"sampler", sampler}})}};
    if (span != 1) texture[i]["extensions"][kTransform] = {{"scale", {span, span}}};
  }
  return file.add("materials", {{"name", "stone"},
                                {"pbrMetallicRoughness",
                                 {{"baseColorTexture", texture[0]},
                                  {"metallicRoughnessTexture", texture[2]},
                                  {"metallicFactor", 0}}},
                                {"normalTexture", texture[1]},
                                {"occlusionTexture", texture[2]}});
}

// One view for an attribute of all meshes, piece after piece.
std::size_t GlbStones::add_attribute_view(const VertexAttribute& attribute, GlbFile& file) const {
  std::uint64_t vertices = 0;
  for (const OutMesh& mesh : meshes_) vertices += mesh.vertices;
  return file.add_view(
      static_cast<std::uint64_t>(attribute.stride) * vertices, kArrayBuffer, attribute.stride,
      [this, rows = attribute.rows](AtomicFile& out) {
        write_pieces(out, [&](const Piece& piece) { return rows(dressed(piece), place(piece)); });
      });
}

void GlbStones::add_meshes(GlbFile& file, std::size_t material) const {
  const std::vector<VertexAttribute> attributes = vertex_attributes(format_);
  std::vector<std::size_t> views;
  for (const VertexAttribute& attribute : attributes)
    views.push_back(add_attribute_view(attribute, file));
  std::uint64_t index_bytes = 0;
  for (const OutMesh& mesh : meshes_) index_bytes += mesh.index_bytes_padded();
  const std::size_t index_view =
      file.add_view(index_bytes, kElementArrayBuffer, 0, [this](AtomicFile& out) {
        write_pieces(out, [this](const Piece& piece) { return indices(piece); });
      });

  std::uint64_t first_vertex = 0, first_index_byte = 0;
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const OutMesh& mesh = meshes_[m];
    json accessors;
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      const VertexAttribute& attribute = attributes[a];
      accessors[attribute.name] = file.add_accessor(
          views[a], static_cast<std::uint64_t>(attribute.stride) * first_vertex,
          attribute.component_type, attribute.shape, mesh.vertices, attribute.normalized);
    }
    json& positions = file.at("accessors", accessors["POSITION"]);
    positions["min"] = list(stored_position(mesh.min, format_));
    positions["max"] = list(stored_position(mesh.max, format_));
    const int index_type = mesh.index_bytes() == 2 ? kUnsignedShort : kUnsignedInt;
    const std::size_t index =
        file.add_accessor(index_view, first_index_byte, index_type, "SCALAR", 3 * mesh.triangles);
    const json primitive = {{"attributes", accessors}, {"indices", index}, {"material", material}};
    file.add("meshes",
             {{"name", fmt::format("stones/{}", m)}, {"primitives", json::array({primitive})}});
    first_vertex += mesh.vertices;
    first_index_byte += mesh.index_bytes_padded();
  }
}

std::vector<std::size_t> GlbStones::add_nodes(GlbFile& file, std::size_t first_mesh) {
  if (params_.instances == InstanceMode::gpu) {
    instances_.emplace(stones_, center_, format_.position_step);
    return instances_->add_to(file, first_mesh);
  }
  std::vector<std::size_t> nodes;
  if (params_.instances == InstanceMode::flattened) {
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      nodes.push_back(
          file.add("nodes", {{"name", fmt::format("stones/{}", m)}, {"mesh", first_mesh + m}}));
    return nodes;
  }
  std::uint32_t in_run = 0;
  for (std::size_t i = 0; i < stones_.instances.size(); ++i) {
    const Instance& instance = stones_.instances[i];
    in_run = i > 0 && stones_.instances[i - 1].prototype == instance.prototype ? in_run + 1 : 0;
    const Vec3 position = y_up(instance.position - center_);
    nodes.push_back(
        file.add("nodes", {{"name", fmt::format("stones/{}/{}", instance.prototype, in_run)},
                           {"mesh", first_mesh + instance.prototype},
                           {"translation", {position.x, position.y, position.z}},
                           {"rotation", y_up(instance.rotation)},
                           {"scale", {instance.scale, instance.scale, instance.scale}}}));
  }
  return nodes;
}

// Encodes many pieces at once and writes them in order.
template <class Encode>
void GlbStones::write_pieces(AtomicFile& file, Encode&& encode) const {
  std::vector<std::vector<std::byte>> batch(kBatchPieces);
  for (std::size_t first = 0; first < pieces_.size(); first += kBatchPieces) {
    check_cancelled(job_);
    const std::size_t count = std::min(kBatchPieces, pieces_.size() - first);
    parallel_for(count, [&](std::size_t i) { batch[i] = encode(pieces_[first + i]); });
    for (std::size_t i = 0; i < count; ++i) file.write(batch[i].data(), batch[i].size());
  }
}

// The last piece of a mesh fills it up to a multiple of four bytes.
std::vector<std::byte> GlbStones::indices(const Piece& piece) const {
  const OutMesh& mesh = meshes_[piece.mesh];
  const std::vector<Triangle>& triangles = dressed(piece).mesh.triangles;
  const std::size_t bytes = mesh.index_bytes();
  std::vector<std::byte> out(3 * triangles.size() * bytes);
  std::size_t at = 0;
  for (const Triangle& t : triangles)
    for (int c = 0; c < 3; ++c, at += bytes) {
      const std::uint32_t index = t[c] + piece.first_vertex;  // its low bytes come first
      std::memcpy(out.data() + at, &index, bytes);
    }
  if (&piece == &pieces_[mesh.first_piece + mesh.piece_count - 1])
    out.resize(out.size() + mesh.index_bytes_padded() - 3 * mesh.triangles * bytes);
  return out;
}

}  // namespace talus
