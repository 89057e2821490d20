// Stones as a part of a GLB file.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "talus/io/dressed_mesh.h"
#include "talus/io/glb_file.h"
#include "talus/io/glb_instances.h"
#include "talus/io/glb_vertices.h"
#include "talus/io/glb_writer.h"

namespace talus {

// Refers to the table and itself holds what is written: both must live until the file is written.
class GlbStones {
 public:
  GlbStones(const InstanceTable& stones, const GlbParams& params, Job* job);

  // Adds meshes, nodes and the material; counts what it adds.
  void add_to(GlbFile& file, GlbStats& stats);

 private:
  // A prototype as it is, or one instance of it put in its place.
  struct Piece {
    std::uint32_t prototype;
    const Instance* instance;
    std::uint32_t first_vertex = 0;  // in its mesh
    std::size_t mesh = 0;
  };
  // A mesh of the file: a run of pieces.
  struct OutMesh {
    std::size_t first_piece = 0;
    std::size_t piece_count = 0;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    Vec3f min{0}, max{0};

    std::uint64_t index_bytes() const { return vertices <= kShortIndexVertices ? 2 : 4; }
    std::uint64_t index_bytes_padded() const { return (3 * triangles * index_bytes() + 3) / 4 * 4; }
  };
  const DressedMesh& dressed(const Piece& piece) const { return dressed_[piece.prototype]; }
  VertexPlace place(const Piece& piece) const { return {piece.instance, center_}; }

  void dress_prototypes();
  void add_piece(Piece piece, bool new_mesh);
  void collect_meshes();
  void measure_meshes();
  void encode_textures();

  std::size_t add_material(GlbFile& file) const;
  std::size_t add_attribute_view(const VertexAttribute& attribute, GlbFile& file) const;
  void add_meshes(GlbFile& file, std::size_t material) const;
  std::vector<std::size_t> add_nodes(GlbFile& file, std::size_t first_mesh);
  template <class Encode>
  void write_pieces(AtomicFile& file, Encode&& encode) const;
  std::vector<std::byte> indices(const Piece& piece) const;

  const InstanceTable& stones_;
  const GlbParams& params_;
  Job* job_;
  Vec3 center_{0};
  std::vector<DressedMesh> dressed_;
  VertexFormat format_;
  std::vector<Piece> pieces_;
  std::vector<OutMesh> meshes_;
  std::array<std::vector<std::byte>, 3> textures_;
  std::optional<GlbInstances> instances_;
};

}  // namespace talus
