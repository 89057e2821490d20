// Stones as a part of a GLB file.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "talus/io/dressed_mesh.h"
#include "talus/io/glb_file.h"
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
  };
  // A mesh of the file: a run of pieces.
  struct OutMesh {
    std::size_t first_piece = 0;
    std::size_t piece_count = 0;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    Box3 box;

    std::uint64_t index_bytes() const { return vertices <= kShortIndexVertices ? 2 : 4; }
    std::uint64_t index_bytes_padded() const { return (3 * triangles * index_bytes() + 3) / 4 * 4; }
  };
  template <class Body>
  void for_pieces(const OutMesh& mesh, Body&& body) const;

  void dress_prototypes();
  void add_piece(const Piece& piece, bool new_mesh);
  void collect_meshes();
  void measure_meshes();
  void encode_textures();
  Vec3f placed(const Piece& piece, const Vec3f& p) const;

  std::size_t add_material(GlbFile& file) const;
  void add_meshes(GlbFile& file, std::size_t material) const;
  void add_nodes(GlbFile& file, std::size_t first_mesh) const;
  void add_instances(GlbFile& file, std::size_t first_mesh) const;
  void write_indices(const OutMesh& mesh, AtomicFile& file) const;
  std::array<double, 3> translation(const Instance& instance) const;

  const InstanceTable& stones_;
  const GlbParams& params_;
  Job* job_;
  Vec3 center_{0};
  std::vector<DressedMesh> dressed_;
  std::vector<Piece> pieces_;
  std::vector<OutMesh> meshes_;
  std::array<std::vector<std::byte>, 3> textures_;
};

}  // namespace talus
