#include "talus/render/stone_buffers.h"

#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <utility>

#include "talus/base/parallel.h"
#include "talus/render/coarse_mesh.h"

namespace talus {

namespace {

// Cells across the plainer meshes. A cell is at most two samples wide where one is drawn: a pixel.
constexpr std::array<int, 3> kCoarseCells = {8, 4, 2};
constexpr double kCellsPerSample = 0.5;
// Below this plainer meshes save less than it takes to make them.
constexpr std::uint64_t kManyTriangles = 2'000'000;

struct GpuVertex {
  Vec3f position;
  std::uint32_t normal;  // 10 bits per axis
};

std::size_t detail_of(double samples_across) {
  std::size_t detail = 0;
  while (detail < kCoarseCells.size() && samples_across * kCellsPerSample < kCoarseCells[detail])
    ++detail;
  return detail;
}

std::shared_ptr<const TriangleMesh> with_normals(std::shared_ptr<const TriangleMesh> mesh) {
  if (mesh->normals.size() == mesh->positions.size()) return mesh;
  auto shaded = std::make_shared<TriangleMesh>(*mesh);
  compute_normals(*shaded);
  return shaded;
}

}  // namespace

StoneBuffers::StoneBuffers(const InstanceTable& table, std::span<const Ball> balls)
    : balls_(balls) {
  // Plainer meshes are independent of each other.
  const bool many = triangle_count(table) > kManyTriangles;
  std::vector<std::vector<std::shared_ptr<const TriangleMesh>>> details(table.prototypes.size());
  parallel_for(details.size(), [&](std::size_t i) {
    details[i].push_back(with_normals(table.prototypes[i]));
    if (!many) return;
    for (const int cells : kCoarseCells)
      details[i].push_back(
          std::make_shared<const TriangleMesh>(coarse_mesh(*details[i].back(), cells)));
  });

  // Where each mesh begins; beyond a prototype's last detail that one goes on.
  std::size_t vertex_count = 0, index_count = 0;
  std::vector<std::array<MeshRange, kDetails>> ranges(details.size());
  for (std::size_t i = 0; i < details.size(); ++i) {
    MeshRange range{};
    for (std::size_t d = 0; d < kDetails; ++d) {
      if (d < details[i].size()) {
        const TriangleMesh& mesh = *details[i][d];
        range = {static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                 static_cast<std::uint32_t>(index_count), static_cast<std::int32_t>(vertex_count)};
        vertex_count += mesh.positions.size();
        index_count += 3 * mesh.triangles.size();
      }
      ranges[i][d] = range;
    }
  }

  std::vector<GpuVertex> vertices(vertex_count);
  std::vector<std::uint32_t> indices(index_count);
  parallel_for(details.size(), [&](std::size_t i) {
    for (std::size_t d = 0; d < details[i].size(); ++d) {
      const TriangleMesh& mesh = *details[i][d];
      GpuVertex* const to = &vertices[static_cast<std::size_t>(ranges[i][d].base_vertex)];
      for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        to[v] = {mesh.positions[v], glm::packSnorm3x10_1x2(glm::vec4(mesh.normals[v], 0))};
      std::uint32_t* corner = &indices[ranges[i][d].first_index];
      for (const Triangle& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) *corner++ = t[c];
    }
    details[i] = {};
  });

  for (std::uint32_t i = 0; i < table.instances.size(); ++i) {
    const std::uint32_t prototype = table.instances[i].prototype;
    if (i == 0 || prototype != table.instances[i - 1].prototype)
      runs_.push_back({i, i, ranges[prototype]});
    runs_.back().end = i + 1;
  }

  vertices_ = gl::make_buffer(std::span<const GpuVertex>(vertices));
  indices_ = gl::make_buffer(std::span<const std::uint32_t>(indices));
  picks_ = gl::make_changing_buffer();
  commands_ = gl::make_changing_buffer();
  vertex_array_ = gl::make_surface_array(vertices_, sizeof(GpuVertex), indices_, picks_);
}

void StoneBuffers::draw(const Sight& sight) const {
  std::vector<std::uint32_t> picks;
  std::vector<DrawCommand> commands;
  std::array<std::vector<std::uint32_t>, kDetails> chosen;
  for (const Run& run : runs_) {
    for (std::uint32_t i = run.begin; i < run.end; ++i)
      if (sight.sees(balls_[i])) chosen[detail_of(sight.samples_across(balls_[i]))].push_back(i);
    for (std::size_t d = 0; d < kDetails; ++d) {
      if (chosen[d].empty()) continue;
      const MeshRange& range = run.details[d];
      commands.push_back({range.count, static_cast<std::uint32_t>(chosen[d].size()),
                          range.first_index, range.base_vertex,
                          static_cast<std::uint32_t>(picks.size())});
      picks.insert(picks.end(), chosen[d].begin(), chosen[d].end());
      chosen[d].clear();
    }
  }
  gl::update_buffer(picks_, std::span<const std::uint32_t>(picks));
  gl::update_buffer(commands_, std::span<const DrawCommand>(commands));
  gl::draw_commands(vertex_array_, commands_, commands.size());
}

}  // namespace talus
