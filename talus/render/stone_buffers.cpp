#include "talus/render/stone_buffers.h"

#include <cstddef>
#include <glm/gtc/packing.hpp>

#include "talus/base/parallel.h"
#include "talus/render/coarse_mesh.h"

namespace talus {

namespace {

// Cells across the plainer meshes. A cell is at most 1.4 samples wide where one is drawn: less than
// a pixel.
constexpr std::array<int, 3> kCoarseCells = {8, 4, 2};
constexpr double kCellsPerSample = 0.7;
// Below this plainer meshes save less than it takes to make them.
constexpr std::uint64_t kManyTriangles = 8'000'000;

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

TriangleMesh with_normals(const TriangleMesh& mesh) {
  TriangleMesh shaded = mesh;
  if (shaded.normals.size() != shaded.positions.size()) compute_normals(shaded);
  return shaded;
}

}  // namespace

StoneBuffers::StoneBuffers(const InstanceTable& table, std::span<const Ball> balls)
    : balls_(balls) {
  // Plainer meshes are independent of each other.
  const bool many = triangle_count(table) > kManyTriangles;
  std::vector<std::vector<TriangleMesh>> details(table.prototypes.size());
  parallel_for(details.size(), [&](std::size_t i) {
    details[i].push_back(with_normals(*table.prototypes[i]));
    if (!many) return;
    for (const int cells : kCoarseCells)
      details[i].push_back(coarse_mesh(details[i].back(), cells));
  });

  std::vector<GpuVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<std::array<MeshRange, kDetails>> ranges(details.size());
  for (std::size_t i = 0; i < details.size(); ++i) {
    for (std::size_t d = 0; d < kDetails; ++d) {
      if (d >= details[i].size()) {
        ranges[i][d] = ranges[i][d - 1];
        continue;
      }
      const TriangleMesh& mesh = details[i][d];
      ranges[i][d] = {static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                      static_cast<std::uint32_t>(indices.size()),
                      static_cast<std::int32_t>(vertices.size())};
      for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        vertices.push_back(
            {mesh.positions[v], glm::packSnorm3x10_1x2(glm::vec4(mesh.normals[v], 0))});
      for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    }
    details[i] = {};
  }

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
