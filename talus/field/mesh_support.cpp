#include "talus/field/mesh_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <span>
#include <vector>

#include "talus/base/parallel.h"
#include "talus/field/mesh_repair.h"
#include "talus/field/winding_number.h"

namespace talus {
namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr double kInsideWinding = 0.5;

bool winds(double w) { return std::abs(w) > kInsideWinding; }

// Six times the volume of the tetrahedron (from, to, a, b), with its sign; the edge's ends are
// taken in order of index so that both triangles of an edge see numbers that differ in sign only.
bool passes_left(const std::vector<Vec3>& vertices, const Vec3& from, const Vec3& to,
                 std::uint32_t a, std::uint32_t b) {
  const bool forward = a < b;
  const Vec3 u = vertices[forward ? a : b] - from, v = vertices[forward ? b : a] - from;
  return (glm::dot(to - from, glm::cross(u, v)) >= 0) == forward;
}

// Cells the box of a triangle touches, clipped to the grid.
struct CellRange {
  Int3 first, last;
};

}  // namespace

// A grid of cells over the mesh. In a cell without triangles all points are alike; in the others
// the winding number at the middle is known, and a point's differs by the crossings in between.
struct MeshSupport::Impl {
  RepairedMesh mesh;
  std::vector<Vec3> normals;  // per triangle, not of unit length
  Box3 box;                   // of the grid: the mesh's box and a cell on every side
  Box3 mesh_box;
  double cell = 0;
  Int3 size{0};
  std::vector<std::uint32_t> first;        // per cell, into `lists`, one past the end last
  std::vector<std::uint32_t> lists;        // triangles
  std::vector<float> winding;              // per cell, at its middle
  std::vector<std::uint32_t> inside_sum;   // prefix sums over (size + 1)^3 of cells wholly inside
  std::vector<std::uint32_t> outside_sum;  // and wholly outside

  std::size_t index(const Int3& c) const {
    return static_cast<std::size_t>(c.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(c.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(c.z));
  }
  std::size_t cells() const { return index({0, 0, size.z}); }
  Vec3 middle(const Int3& c) const { return box.min + cell * (Vec3(c) + 0.5); }
  Int3 cell_of(const Vec3& p) const {
    return glm::clamp(Int3(glm::floor((p - box.min) / cell)), Int3(0), size - 1);
  }
  std::span<const std::uint32_t> triangles_in(std::size_t c) const {
    return {lists.data() + first[c], first[c + 1] - first[c]};
  }

  void make_grid();
  void list_triangles();
  CellRange cells_near(const Corners& t) const;
  bool plane_meets_cell(std::size_t t, const Int3& c) const;
  void wind_cells(Job* job);
  void sum_cells();
  int crossings(std::span<const std::uint32_t> triangles, const Vec3& from, const Vec3& to) const;
  double winding_at(const Vec3& p) const;
  double enclosed_volume() const;
};

// A few triangles to a cell that holds any, within bounds that keep memory small; fewer cells where
// each needs a winding number of its own.
void MeshSupport::Impl::make_grid() {
  for (const Corners& t : mesh.triangles)
    for (const std::uint32_t v : t) mesh_box.include(mesh.vertices[v]);
  const double wanted = 0.5 * std::sqrt(static_cast<double>(mesh.triangles.size()));
  cell = mesh_box.longest_side() / std::clamp(wanted, 24.0, mesh.balanced ? 128.0 : 64.0);
  box = mesh_box.expanded(cell);
  size = Int3(glm::ceil(box.size() / cell));
}

CellRange MeshSupport::Impl::cells_near(const Corners& t) const {
  Box3 near;
  for (const std::uint32_t v : t) near.include(mesh.vertices[v]);
  const Box3 padded = near.expanded(1e-6 * cell);  // a triangle on a cell's border is in both
  return {cell_of(padded.min), cell_of(padded.max)};
}

bool MeshSupport::Impl::plane_meets_cell(std::size_t t, const Int3& c) const {
  const Vec3& n = normals[t];
  const double extent = 0.5 * cell * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const double offset = glm::dot(n, middle(c) - mesh.vertices[mesh.triangles[t][0]]);
  return std::abs(offset) <= extent * (1 + 1e-6);
}

void MeshSupport::Impl::list_triangles() {
  for (const Corners& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    normals.push_back(glm::cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
  }
  const auto for_each_entry = [&](auto&& use) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const CellRange range = cells_near(mesh.triangles[t]);
      for (int z = range.first.z; z <= range.last.z; ++z)
        for (int y = range.first.y; y <= range.last.y; ++y)
          for (int x = range.first.x; x <= range.last.x; ++x)
            if (plane_meets_cell(t, {x, y, z})) use(index({x, y, z}), t);
    }
  };
  first.assign(cells() + 1, 0);
  for_each_entry([&](std::size_t c, std::size_t) { ++first[c + 1]; });
  for (std::size_t c = 0; c < cells(); ++c) first[c + 1] += first[c];
  lists.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_entry(
      [&](std::size_t c, std::size_t t) { lists[next[c]++] = static_cast<std::uint32_t>(t); });
}

// How the winding number changes from one point to another in the same cell: + 1 for every
// triangle crossed from its front to its back.
int MeshSupport::Impl::crossings(std::span<const std::uint32_t> triangles, const Vec3& from,
                                 const Vec3& to) const {
  int sum = 0;
  for (const std::uint32_t t : triangles) {
    const Corners& c = mesh.triangles[t];
    const Vec3& corner = mesh.vertices[c[0]];
    const bool from_front = glm::dot(normals[t], from - corner) >= 0;
    const bool to_front = glm::dot(normals[t], to - corner) >= 0;
    if (from_front == to_front) continue;
    const bool left = passes_left(mesh.vertices, from, to, c[0], c[1]);
    if (passes_left(mesh.vertices, from, to, c[1], c[2]) == left &&
        passes_left(mesh.vertices, from, to, c[2], c[0]) == left)
      sum += from_front ? 1 : -1;
  }
  return sum;
}

void MeshSupport::Impl::wind_cells(Job* job) {
  winding.assign(cells(), 0);
  if (mesh.balanced) {
    // Rows start outside; from middle to middle only the two cells' triangles can lie in between.
    const auto rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    parallel_for(rows, [&](std::size_t row) {
      check_cancelled(job);
      const int y = static_cast<int>(row) % size.y, z = static_cast<int>(row) / size.y;
      std::vector<std::uint32_t> both;
      int w = 0;
      for (int x = 1; x < size.x; ++x) {
        const auto a = triangles_in(index({x - 1, y, z})), b = triangles_in(index({x, y, z}));
        both.clear();
        std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        w += crossings(both, middle({x - 1, y, z}), middle({x, y, z}));
        winding[index({x, y, z})] = static_cast<float>(w);
      }
    });
    return;
  }
  std::vector<std::array<Vec3, 3>> soup;
  for (const Corners& t : mesh.triangles)
    soup.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  const WindingNumber number(soup);
  parallel_for(
      cells(),
      [&](std::size_t c) {
        check_cancelled(job);
        const int i = static_cast<int>(c);
        const Int3 at(i % size.x, i / size.x % size.y, i / (size.x * size.y));
        winding[c] = static_cast<float>(number.at(middle(at)));
      },
      256);
}

void MeshSupport::Impl::sum_cells() {
  const Int3 s = size + 1;
  const auto at = [&](int x, int y, int z) {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(s.x) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(s.y) * static_cast<std::size_t>(z));
  };
  inside_sum.assign(at(0, 0, s.z), 0);
  outside_sum.assign(at(0, 0, s.z), 0);
  for (int z = 1; z < s.z; ++z)
    for (int y = 1; y < s.y; ++y)
      for (int x = 1; x < s.x; ++x) {
        const std::size_t c = index({x - 1, y - 1, z - 1});
        const bool mixed = !triangles_in(c).empty();
        for (auto* sum : {&inside_sum, &outside_sum}) {
          auto& v = *sum;
          const bool counts = !mixed && winds(winding[c]) == (sum == &inside_sum);
          v[at(x, y, z)] = counts + v[at(x - 1, y, z)] + v[at(x, y - 1, z)] + v[at(x, y, z - 1)] -
                           v[at(x - 1, y - 1, z)] - v[at(x - 1, y, z - 1)] -
                           v[at(x, y - 1, z - 1)] + v[at(x - 1, y - 1, z - 1)];
        }
      }
}

double MeshSupport::Impl::winding_at(const Vec3& p) const {
  const Int3 c = cell_of(p);
  const std::size_t i = index(c);
  return double{winding[i]} + crossings(triangles_in(i), middle(c), p);
}

// Cells without triangles count whole, the others by eight points.
double MeshSupport::Impl::enclosed_volume() const {
  double in_cells = 0;
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const std::size_t i = index({x, y, z});
        if (triangles_in(i).empty()) {
          in_cells += winds(winding[i]);
          continue;
        }
        for (int k = 0; k < 8; ++k) {
          const Vec3 offset = 0.5 * Vec3(k & 1, k >> 1 & 1, k >> 2 & 1) - 0.25;
          in_cells += 0.125 * winds(winding_at(middle({x, y, z}) + cell * offset));
        }
      }
  return in_cells * cell * cell * cell;
}

MeshSupport::MeshSupport(const TriangleMesh& mesh, Job* job) {
  auto impl = std::make_unique<Impl>();
  impl->mesh = repair(mesh);
  constexpr const char* kNoVolume =
      "the mesh encloses no volume; give a closed surface, or one with small holes only";
  if (impl->mesh.triangles.empty()) throw input_error(kNoVolume);
  impl->make_grid();
  impl->list_triangles();
  impl->wind_cells(job);
  impl->sum_cells();
  impl->mesh.report.volume = impl->enclosed_volume();
  if (impl->mesh.report.volume == 0) throw input_error(kNoVolume);
  impl_ = std::move(impl);
}

MeshSupport::~MeshSupport() = default;

bool MeshSupport::contains(const Vec3& p) const {
  return impl_->mesh_box.contains(p) && winds(impl_->winding_at(p));
}

BoxState MeshSupport::classify(const Box3& query) const {
  const Impl& m = *impl_;
  const bool reaches_out = glm::any(glm::lessThan(query.min, m.mesh_box.min)) ||
                           glm::any(glm::greaterThan(query.max, m.mesh_box.max));
  const Box3 part{glm::max(query.min, m.mesh_box.min), glm::min(query.max, m.mesh_box.max)};
  if (part.empty()) return BoxState::outside;
  const Int3 a = m.cell_of(part.min), b = m.cell_of(part.max) + 1;
  const Int3 s = m.size + 1;
  const auto total = [&](const std::vector<std::uint32_t>& sum) {
    const auto at = [&](int x, int y, int z) {
      return sum[static_cast<std::size_t>(x) +
                 static_cast<std::size_t>(s.x) *
                     (static_cast<std::size_t>(y) +
                      static_cast<std::size_t>(s.y) * static_cast<std::size_t>(z))];
    };
    return at(b.x, b.y, b.z) - at(a.x, b.y, b.z) - at(b.x, a.y, b.z) - at(b.x, b.y, a.z) +
           at(a.x, a.y, b.z) + at(a.x, b.y, a.z) + at(b.x, a.y, a.z) - at(a.x, a.y, a.z);
  };
  const Int3 span = b - a;
  const auto all = static_cast<std::uint32_t>(span.x * span.y * span.z);
  if (total(m.outside_sum) == all) return BoxState::outside;
  if (!reaches_out && total(m.inside_sum) == all) return BoxState::inside;
  return BoxState::mixed;
}

Box3 MeshSupport::bounds() const { return impl_->mesh_box; }

const MeshSupportReport& MeshSupport::report() const { return impl_->mesh.report; }

}  // namespace talus
