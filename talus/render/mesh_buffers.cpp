#include "talus/render/mesh_buffers.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "talus/render/gpu_layout.h"

namespace talus {

namespace {

// Pieces of a mesh along the longest side of its box.
constexpr int kPiecesAcross = 32;

struct GpuMeshVertex {
  Vec3f position;
  std::uint32_t normal;  // 10 bits per axis
  MaterialShares shares;
};

// The corners of a mesh's triangles, those in each cell of a grid together: compact pieces, of
// which a view needs few.
std::vector<std::vector<std::uint32_t>> divided(const TriangleMesh& mesh) {
  const Box3 box = bounds(mesh);
  const double cell = std::max(box.longest_side(), 1e-30) / kPiecesAcross;
  const Int3 size = glm::min(Int3(box.size() / cell) + 1, Int3(kPiecesAcross));
  std::vector<std::vector<std::uint32_t>> pieces(
      static_cast<std::size_t>(size.x * size.y * size.z));
  for (const Triangle& t : mesh.triangles) {
    const Int3 at = glm::min(Int3((Vec3(mesh.positions[t.x]) - box.min) / cell), size - 1);
    std::vector<std::uint32_t>& piece =
        pieces[static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z))];
    piece.insert(piece.end(), {t.x, t.y, t.z});
  }
  std::erase_if(pieces, [](const auto& piece) { return piece.empty(); });
  return pieces;
}

}  // namespace

MeshBuffers::MeshBuffers(std::span<const PlacedMesh> meshes) {
  std::vector<GpuMeshVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> picks;
  for (const PlacedMesh& placed : meshes) {
    const TriangleMesh& mesh = *placed.mesh;
    TriangleMesh shaded;
    if (mesh.normals.size() != mesh.positions.size()) {
      shaded = mesh;
      compute_normals(shaded);
    }
    const std::vector<Vec3f>& normals = shaded.normals.empty() ? mesh.normals : shaded.normals;
    const auto base = static_cast<std::int32_t>(vertices.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      vertices.push_back({mesh.positions[i], glm::packSnorm3x10_1x2(glm::vec4(normals[i], 0)),
                          mesh.shares.empty() ? MaterialShares{} : mesh.shares[i]});

    for (const std::vector<std::uint32_t>& corners : divided(mesh)) {
      Box3 box;
      for (const std::uint32_t v : corners) box.include(Vec3(mesh.positions[v]));
      pieces_.push_back({.ball = {.center = placed.position + placed.scale * box.center(),
                                  .radius = 0.5 * placed.scale * glm::length(box.size())},
                         .count = static_cast<std::uint32_t>(corners.size()),
                         .first_index = static_cast<std::uint32_t>(indices.size()),
                         .base_vertex = base,
                         .mesh = static_cast<std::uint32_t>(picks.size())});
      indices.insert(indices.end(), corners.begin(), corners.end());
    }
    picks.push_back(placed.instance);
  }

  vertices_ = gl::make_buffer(std::span<const GpuMeshVertex>(vertices));
  indices_ = gl::make_buffer(std::span<const std::uint32_t>(indices));
  picks_ = gl::make_buffer(std::span<const std::uint32_t>(picks));
  commands_ = gl::make_changing_buffer();
  vertex_array_ = gl::make_surface_array(vertices_, sizeof(GpuMeshVertex), indices_, picks_);
  const GLuint array = vertex_array_.id();
  for (GLuint half = 0; half < 2; ++half) {
    glEnableVertexArrayAttrib(array, 3 + half);
    glVertexArrayAttribFormat(array, 3 + half, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                              static_cast<GLuint>(offsetof(GpuMeshVertex, shares)) + 4 * half);
    glVertexArrayAttribBinding(array, 3 + half, 0);
  }
}

void MeshBuffers::draw(const Sight& sight) const {
  std::vector<DrawCommand> commands;
  for (const Piece& piece : pieces_)
    if (sight.sees(piece.ball))
      commands.push_back({piece.count, 1, piece.first_index, piece.base_vertex, piece.mesh});
  gl::update_buffer(commands_, std::span<const DrawCommand>(commands));
  gl::draw_commands(vertex_array_, commands_, commands.size());
}

}  // namespace talus
