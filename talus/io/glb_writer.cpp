#include "talus/io/glb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "talus/io/atomic_file.h"
#include "talus/io/dressed_mesh.h"
#include "talus/io/gltf_document.h"
#include "talus/io/png.h"
#include "talus/io/stone_material.h"

namespace talus {
namespace {

using nlohmann::json;

constexpr std::uint64_t kChunkVertices = 4'000'000;
constexpr std::uint64_t kShortIndexVertices = 65'535;  // the last 16-bit index restarts primitives
constexpr int kVertexPasses = 5;  // over all vertices while the file is written
constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

Vec3f y_up(const Vec3f& p) { return {p.x, p.z, -p.y}; }

// A prototype as it is, or one instance of it put in its place.
struct Piece {
  std::uint32_t prototype;
  const Instance* instance;
};

// A mesh of the file: a run of pieces.
struct OutMesh {
  std::size_t first_piece = 0;
  std::size_t piece_count = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  Vec3f min{std::numeric_limits<float>::infinity()};
  Vec3f max{-std::numeric_limits<float>::infinity()};

  std::uint64_t index_bytes() const { return vertices <= kShortIndexVertices ? 2 : 4; }
  std::uint64_t index_bytes_padded() const { return (3 * triangles * index_bytes() + 3) / 4 * 4; }
};

class GlbScene {
 public:
  GlbScene(const InstanceTable& stones, const GlbParams& params, Job* job)
      : stones_(stones), params_(params), job_(job) {
    if (!stones.instances.empty()) center_ = bounds_of_positions();
    dress_prototypes();
    collect_meshes();
    measure_meshes();
    if (!meshes_.empty()) encode_textures();
  }

  GlbStats write(const std::filesystem::path& path) {
    const json document = describe();
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + text.size() + (bin_bytes_ > 0 ? 8 + bin_bytes_ : 0);
    if (total > std::numeric_limits<std::uint32_t>::max())
      throw job_error(
          fmt::format("{}: the scene takes {:.1f} GiB, a GLB holds at most 4; write "
                      "instances, or fewer stones",
                      path.string(), static_cast<double>(total) / (1ull << 30)));
    AtomicFile file(path);
    file.write("glTF");
    file.write_value(std::uint32_t{2});
    file.write_value(static_cast<std::uint32_t>(total));
    file.write_value(static_cast<std::uint32_t>(text.size()));
    file.write("JSON");
    file.write(text);
    if (bin_bytes_ > 0) write_bin(file);
    TALUS_ASSERT(file.size() == total);
    file.commit();

    GlbStats stats{.bytes = total, .nodes = nodes_, .meshes = meshes_.size()};
    for (const OutMesh& mesh : meshes_) {
      stats.vertices += mesh.vertices;
      stats.triangles += mesh.triangles;
    }
    return stats;
  }

 private:
  // Middle of the instances' positions, rounded so that it is short in the file.
  Vec3 bounds_of_positions() const {
    Box3 box;
    for (const Instance& instance : stones_.instances) box.include(instance.position);
    return glm::round(box.center());
  }

  void dress_prototypes() {
    dressed_.resize(stones_.prototypes.size());
    parallel_for(dressed_.size(), [&](std::size_t k) {
      check_cancelled(job_);
      dressed_[k] = dress(*stones_.prototypes[k], params_.seed, static_cast<std::uint32_t>(k));
    });
  }

  void add_piece(const Piece& piece, bool new_mesh) {
    if (new_mesh) meshes_.push_back({.first_piece = pieces_.size()});
    pieces_.push_back(piece);
    const DressedMesh& dressed = dressed_[piece.prototype];
    OutMesh& mesh = meshes_.back();
    ++mesh.piece_count;
    mesh.vertices += dressed.mesh.positions.size();
    mesh.triangles += dressed.mesh.triangles.size();
  }

  void collect_meshes() {
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

  Vec3f placed(const Piece& piece, const Vec3f& p) const {
    if (!piece.instance) return y_up(p);
    return y_up(Vec3f(world_from_local(*piece.instance, p) - center_));
  }

  static Vec3f turned(const Piece& piece, const Vec3f& direction) {
    if (!piece.instance) return y_up(direction);
    return y_up(glm::normalize(piece.instance->rotation * direction));
  }

  template <class Body>
  void for_pieces(const OutMesh& mesh, Body&& body) const {
    for (std::size_t i = 0; i < mesh.piece_count; ++i) {
      const Piece& piece = pieces_[mesh.first_piece + i];
      body(piece, dressed_[piece.prototype]);
    }
  }

  void measure_meshes() {
    parallel_for(meshes_.size(), [&](std::size_t m) {
      OutMesh& mesh = meshes_[m];
      for_pieces(mesh, [&](const Piece& piece, const DressedMesh& dressed) {
        check_cancelled(job_);
        for (const Vec3f& p : dressed.mesh.positions) {
          mesh.min = glm::min(mesh.min, placed(piece, p));
          mesh.max = glm::max(mesh.max, placed(piece, p));
        }
      });
    });
  }

  void encode_textures() {
    const StoneTextures textures = make_stone_textures(params_.seed);
    const std::array<const Image*, 3> images = {&textures.base_color, &textures.normal,
                                                &textures.occlusion_roughness};
    parallel_for(images.size(), [&](std::size_t i) { textures_[i] = encode_png(*images[i]); });
  }

  // --- The document -----------------------------------------------------------------------------

  std::size_t add_view(std::uint64_t bytes, int target, int stride) {
    json view = {{"buffer", 0}, {"byteOffset", bin_bytes_}, {"byteLength", bytes}};
    if (target != 0) view["target"] = target;
    if (stride != 0) view["byteStride"] = stride;
    views_.push_back(std::move(view));
    bin_bytes_ += (bytes + 3) / 4 * 4;
    return views_.size() - 1;
  }

  std::size_t add_accessor(std::size_t view, std::uint64_t offset, int component_type,
                           const char* type, std::uint64_t count) {
    accessors_.push_back({{"bufferView", view},
                          {"byteOffset", offset},
                          {"componentType", component_type},
                          {"type", type},
                          {"count", count}});
    return accessors_.size() - 1;
  }

  json describe_meshes() {
    std::uint64_t vertices = 0, index_bytes = 0;
    for (const OutMesh& mesh : meshes_) {
      vertices += mesh.vertices;
      index_bytes += mesh.index_bytes_padded();
    }
    const std::size_t positions = add_view(12 * vertices, kArrayBuffer, 12);
    const std::size_t normals = add_view(12 * vertices, kArrayBuffer, 12);
    const std::size_t tangents = add_view(16 * vertices, kArrayBuffer, 16);
    const std::size_t coordinates = add_view(8 * vertices, kArrayBuffer, 8);
    const std::size_t colors = add_view(4 * vertices, kArrayBuffer, 4);
    const std::size_t indices = add_view(index_bytes, kElementArrayBuffer, 0);

    json meshes = json::array();
    std::uint64_t first_vertex = 0, first_index_byte = 0;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      const OutMesh& mesh = meshes_[m];
      const std::size_t position =
          add_accessor(positions, 12 * first_vertex, kFloat, "VEC3", mesh.vertices);
      accessors_[position]["min"] = {mesh.min.x, mesh.min.y, mesh.min.z};
      accessors_[position]["max"] = {mesh.max.x, mesh.max.y, mesh.max.z};
      const std::size_t color =
          add_accessor(colors, 4 * first_vertex, kUnsignedByte, "VEC4", mesh.vertices);
      accessors_[color]["normalized"] = true;
      const json attributes = {
          {"POSITION", position},
          {"NORMAL", add_accessor(normals, 12 * first_vertex, kFloat, "VEC3", mesh.vertices)},
          {"TANGENT", add_accessor(tangents, 16 * first_vertex, kFloat, "VEC4", mesh.vertices)},
          {"TEXCOORD_0",
           add_accessor(coordinates, 8 * first_vertex, kFloat, "VEC2", mesh.vertices)},
          {"COLOR_0", color}};
      const int index_type = mesh.index_bytes() == 2 ? kUnsignedShort : kUnsignedInt;
      const std::size_t index =
          add_accessor(indices, first_index_byte, index_type, "SCALAR", 3 * mesh.triangles);
      const json primitive = {{"attributes", attributes}, {"indices", index}, {"material", 0}};
      meshes.push_back(
          {{"name", fmt::format("stones/{}", m)}, {"primitives", json::array({primitive})}});
      first_vertex += mesh.vertices;
      first_index_byte += mesh.index_bytes_padded();
    }
    return meshes;
  }

  std::array<double, 3> translation(const Instance& instance) const {
    const Vec3 p = instance.position - center_;
    return {p.x, p.z, -p.y};
  }
  static std::array<double, 4> rotation(const Instance& instance) {
    const glm::dquat q = glm::normalize(glm::dquat(instance.rotation));
    return {q.x, q.z, -q.y, q.w};
  }

  json describe_nodes() {
    json nodes =
        json::array({{{"name", "stones"}, {"translation", {center_.x, center_.z, -center_.y}}}});
    const std::size_t count = stones_.instances.size();
    if (params_.instances == InstanceMode::flattened) {
      for (std::size_t m = 0; m < meshes_.size(); ++m)
        nodes.push_back({{"name", fmt::format("stones/{}", m)}, {"mesh", m}});
    } else if (params_.instances == InstanceMode::nodes) {
      std::uint32_t in_run = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Instance& instance = stones_.instances[i];
        in_run = i > 0 && stones_.instances[i - 1].prototype == instance.prototype ? in_run + 1 : 0;
        nodes.push_back({{"name", fmt::format("stones/{}/{}", instance.prototype, in_run)},
                         {"mesh", instance.prototype},
                         {"translation", translation(instance)},
                         {"rotation", rotation(instance)},
                         {"scale", {instance.scale, instance.scale, instance.scale}}});
      }
    } else {
      const std::size_t translations = add_view(12 * count, 0, 0);
      const std::size_t rotations = add_view(16 * count, 0, 0);
      const std::size_t scales = add_view(12 * count, 0, 0);
      for (std::size_t first = 0, end = 0; first < count; first = end) {
        const std::uint32_t prototype = stones_.instances[first].prototype;
        while (end < count && stones_.instances[end].prototype == prototype) ++end;
        const std::uint64_t n = end - first;
        const json attributes = {
            {"TRANSLATION", add_accessor(translations, 12 * first, kFloat, "VEC3", n)},
            {"ROTATION", add_accessor(rotations, 16 * first, kFloat, "VEC4", n)},
            {"SCALE", add_accessor(scales, 12 * first, kFloat, "VEC3", n)}};
        nodes.push_back({{"name", fmt::format("stones/{}", prototype)},
                         {"mesh", prototype},
                         {"extensions", {{kInstancingExtension, {{"attributes", attributes}}}}}});
      }
    }
    for (std::size_t i = 1; i < nodes.size(); ++i) nodes[0]["children"].push_back(i);
    nodes_ = nodes.size();
    return nodes;
  }

  json describe() {
    json document = {{"asset", {{"version", "2.0"}, {"generator", "Talus"}}}, {"scene", 0}};
    if (meshes_.empty()) {
      document["scenes"] = json::array({{{"name", "scene"}}});
      return document;
    }
    document["scenes"] = json::array({{{"name", "scene"}, {"nodes", json::array({0})}}});
    document["meshes"] = describe_meshes();
    document["nodes"] = describe_nodes();
    if (params_.instances == InstanceMode::gpu)
      document["extensionsUsed"] = document["extensionsRequired"] =
          json::array({kInstancingExtension});

    constexpr std::array<const char*, 3> kNames = {"stone base color", "stone normal",
                                                   "stone occlusion roughness"};
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      document["images"].push_back({{"name", kNames[i]},
                                    {"mimeType", "image/png"},
                                    {"bufferView", add_view(textures_[i].size(), 0, 0)}});
      document["textures"].push_back({{"source", i}, {"sampler", 0}});
    }
    document["samplers"].push_back(
        {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
    document["materials"].push_back({{"name", "stone"},
                                     {"pbrMetallicRoughness",
                                      {{"baseColorTexture", {{"index", 0}}},
                                       {"metallicRoughnessTexture", {{"index", 2}}},
                                       {"metallicFactor", 0}}},
                                     {"normalTexture", {{"index", 1}}},
                                     {"occlusionTexture", {{"index", 2}}}});
    document["accessors"] = std::move(accessors_);
    document["bufferViews"] = std::move(views_);
    document["buffers"].push_back({{"byteLength", bin_bytes_}});
    return document;
  }

  // --- The binary chunk, in the order of the views
  // ------------------------------------------------

  void write_bin(AtomicFile& file) const {
    file.write_value(static_cast<std::uint32_t>(bin_bytes_));
    file.write(std::string_view("BIN\0", 4));
    const auto each = [&](double done, auto&& write_piece) {
      for (std::size_t m = 0; m < meshes_.size(); ++m) {
        for_pieces(meshes_[m], write_piece);
        report_progress(job_, "write GLB",
                        (done + static_cast<double>(m + 1) / static_cast<double>(meshes_.size())) /
                            kVertexPasses);
      }
    };
    each(0, [&](const Piece& piece, const DressedMesh& dressed) {
      for (const Vec3f& p : dressed.mesh.positions) file.write_value(placed(piece, p));
    });
    each(1, [&](const Piece& piece, const DressedMesh& dressed) {
      for (const Vec3f& n : dressed.mesh.normals) file.write_value(turned(piece, n));
    });
    each(2, [&](const Piece& piece, const DressedMesh& dressed) {
      for (const glm::vec4& t : dressed.tangents)
        file.write_value(glm::vec4(turned(piece, Vec3f(t)), t.w));
    });
    each(3, [&](const Piece&, const DressedMesh& dressed) {
      file.write(dressed.texture_coordinates.data(), 8 * dressed.texture_coordinates.size());
    });
    each(4, [&](const Piece&, const DressedMesh& dressed) {
      file.write(dressed.colors.data(), 4 * dressed.colors.size());
    });
    for (const OutMesh& mesh : meshes_) write_indices(mesh, file);
    if (params_.instances == InstanceMode::gpu) write_instances(file);
    for (const std::vector<std::byte>& png : textures_) {
      file.write(png.data(), png.size());
      pad(file);
    }
  }

  void write_indices(const OutMesh& mesh, AtomicFile& file) const {
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

  void write_instances(AtomicFile& file) const {
    for (const Instance& instance : stones_.instances)
      for (const double x : translation(instance)) file.write_value(static_cast<float>(x));
    for (const Instance& instance : stones_.instances)
      for (const double x : rotation(instance)) file.write_value(static_cast<float>(x));
    for (const Instance& instance : stones_.instances) file.write_value(Vec3f(instance.scale));
  }

  // Chunks and views begin at multiples of four.
  static void pad(AtomicFile& file) {
    while (file.size() % 4 != 0) file.write_value('\0');
  }

  const InstanceTable& stones_;
  const GlbParams& params_;
  Job* job_;
  Vec3 center_{0};
  std::vector<DressedMesh> dressed_;
  std::vector<Piece> pieces_;
  std::vector<OutMesh> meshes_;
  std::array<std::vector<std::byte>, 3> textures_;
  json views_ = json::array(), accessors_ = json::array();
  std::uint64_t bin_bytes_ = 0;
  std::uint64_t nodes_ = 0;
};

}  // namespace

GlbStats write_glb(const std::filesystem::path& path, const SceneView& scene,
                   const GlbParams& params, Job* job) {
  const InstanceTable empty;
  return GlbScene(scene.stones ? *scene.stones : empty, params, job).write(path);
}

}  // namespace talus
