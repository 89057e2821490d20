#include "talus/field/mesh_support.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <vector>

#include "talus/base/parallel.h"
#include "talus/field/mesh_repair.h"
#include "talus/field/triangle_grid.h"
#include "talus/field/winding_number.h"

namespace talus {
namespace {

bool winds(double w) { return std::abs(w) > 0.5; }

// Entries of a triangle grid, estimated from the triangles' boxes.
double entries(const RepairedMesh& mesh, double cell) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    Box3 box;
    for (int k = 0; k < 3; ++k) box.include(mesh.vertices[t[k]]);
    const Vec3 cells = box.size() / cell + 1.0;
    // A triangle cuts its box along a plane: about as many cells as the box's largest face has.
    sum += cells.x * cells.y * cells.z / std::min({cells.x, cells.y, cells.z});
  }
  return sum;
}

// A few triangles to a cell that holds any, within bounds that keep memory small; a cell of margin
// on every side.
CellGrid make_grid(const Box3& box, const RepairedMesh& mesh) {
  constexpr double kMaxEntries = 5e7, kLeastAlong = 6;
  const auto triangles = static_cast<double>(mesh.triangles.size());
  double cells_along = std::clamp(0.5 * std::sqrt(triangles), 24.0, 128.0);
  while (entries(mesh, box.longest_side() / cells_along) > kMaxEntries) {
    cells_along /= 2;
    if (cells_along < kLeastAlong)
      throw input_error(
          "the mesh has too many triangles that span most of it to tell its inside; "
          "give a surface, not a soup of large triangles");
  }
  CellGrid grid;
  grid.cell = box.longest_side() / cells_along;
  const Box3 padded = box.expanded(grid.cell);
  grid.origin = padded.min;
  grid.size = Int3(glm::ceil(padded.size() / grid.cell));
  return grid;
}

// Counts of cells in every box that starts at the grid's corner, to count any box in eight steps.
class CellSums {
 public:
  CellSums(const CellGrid& grid, auto&& counts) : size_(grid.size + 1) {
    sums_.assign(at({0, 0, size_.z}), 0);
    for (int z = 1; z < size_.z; ++z)
      for (int y = 1; y < size_.y; ++y)
        for (int x = 1; x < size_.x; ++x)
          sums_[at({x, y, z})] = counts(grid.index({x - 1, y - 1, z - 1})) + sum({x - 1, y, z}) +
                                 sum({x, y - 1, z}) + sum({x, y, z - 1}) - sum({x - 1, y - 1, z}) -
                                 sum({x - 1, y, z - 1}) - sum({x, y - 1, z - 1}) +
                                 sum({x - 1, y - 1, z - 1});
  }
  // Cells from a to b, the end excluded, that count.
  std::uint32_t between(const Int3& a, const Int3& b) const {
    return sum(b) - sum({a.x, b.y, b.z}) - sum({b.x, a.y, b.z}) - sum({b.x, b.y, a.z}) +
           sum({a.x, a.y, b.z}) + sum({a.x, b.y, a.z}) + sum({b.x, a.y, a.z}) - sum(a);
  }

 private:
  std::size_t at(const Int3& c) const {
    return static_cast<std::size_t>(c.x) +
           static_cast<std::size_t>(size_.x) *
               (static_cast<std::size_t>(c.y) +
                static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(c.z));
  }
  std::uint32_t sum(const Int3& c) const { return sums_[at(c)]; }

  Int3 size_;
  std::vector<std::uint32_t> sums_;
};

// How often the triangles wind around the middle of every cell, given that they close: rows start
// outside, and from middle to middle only the two cells' triangles can lie in between.
void add_closed_winding(const CellGrid& grid, const TriangleGrid& triangles,
                        std::vector<float>& winding, Job* job) {
  const auto rows = static_cast<std::size_t>(grid.size.y) * static_cast<std::size_t>(grid.size.z);
  parallel_for(rows, [&](std::size_t row) {
    check_cancelled(job);
    const int y = static_cast<int>(row) % grid.size.y, z = static_cast<int>(row) / grid.size.y;
    std::vector<std::uint32_t> both;
    int w = 0;
    for (int x = 1; x < grid.size.x; ++x) {
      const std::size_t c = grid.index({x, y, z});
      const auto a = triangles.in_cell(c - 1), b = triangles.in_cell(c);
      both.clear();
      std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
      w += triangles.crossings(both, grid.middle({x - 1, y, z}), grid.middle({x, y, z}));
      winding[c] += static_cast<float>(w);
    }
  });
}

// The winding number of a mesh at the middle of every cell. A mesh with holes is one closed surface
// less the caps over its holes: the first is counted exactly, the second is few triangles.
std::vector<float> wind_cells(const CellGrid& grid, const TriangleGrid& surface,
                              const RepairedMesh& mesh, Job* job) {
  std::vector<float> winding(grid.count(), 0);
  if (mesh.caps.empty()) {
    add_closed_winding(grid, surface, winding, job);
    return winding;
  }
  std::vector<Triangle> closed = mesh.triangles;
  closed.insert(closed.end(), mesh.caps.begin(), mesh.caps.end());
  add_closed_winding(grid, TriangleGrid(grid, mesh.vertices, closed, job), winding, job);

  std::vector<std::array<Vec3, 3>> soup;
  for (const Triangle& t : mesh.caps)
    soup.push_back({mesh.vertices[t.x], mesh.vertices[t.y], mesh.vertices[t.z]});
  const WindingNumber caps(soup);
  parallel_for(
      grid.count(),
      [&](std::size_t c) {
        check_cancelled(job);
        const int i = static_cast<int>(c);
        const Int3 at(i % grid.size.x, i / grid.size.x % grid.size.y,
                      i / (grid.size.x * grid.size.y));
        winding[c] -= static_cast<float>(caps.at(grid.middle(at)));
      },
      256);
  return winding;
}

Box3 box_of(const RepairedMesh& mesh) {
  Box3 box;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) box.include(mesh.vertices[t[k]]);
  return box;
}

// The points of a block that are among some and connected to one of them, from neighbor to
// neighbor.
std::uint64_t connected(std::uint64_t seed, std::uint64_t among) {
  constexpr std::uint64_t kNotLastX = 0x7777777777777777, kNotLastY = 0x0fff0fff0fff0fff;
  for (;;) {
    const std::uint64_t grown = seed | (seed & kNotLastX) << 1 | (seed >> 1 & kNotLastX) |
                                (seed & kNotLastY) << 4 | (seed >> 4 & kNotLastY) | seed << 16 |
                                seed >> 16;
    if ((grown & among) == seed) return seed;
    seed = grown & among;
  }
}

}  // namespace

// In a cell without triangles all points are alike; in the others the winding number at the middle
// is known, and a point's differs by the crossings in between.
struct MeshSupport::Impl {
  Impl(const RepairedMesh& mesh, Job* job)
      : report(mesh.report),
        box(box_of(mesh)),
        grid(make_grid(box, mesh)),
        has_holes(!mesh.caps.empty()),
        surface(grid, mesh.vertices, mesh.triangles, job),
        winding(wind_cells(grid, surface, mesh, job)),
        inside(grid, [&](std::size_t c) { return is_empty(c) && winds(winding[c]); }),
        outside(grid, [&](std::size_t c) { return is_empty(c) && !winds(winding[c]); }) {
    if (!mesh.caps.empty()) report.volume = enclosed_volume();
    report.overlapping =
        std::any_of(winding.begin(), winding.end(), [](float w) { return std::abs(w) > 1.5f; });
  }

  bool is_empty(std::size_t c) const { return surface.in_cell(c).empty(); }

  double winding_at(const Vec3& p) const {
    const Int3 c = grid.cell_of(p);
    const std::size_t i = grid.index(c);
    return double{winding[i]} + surface.crossings(surface.in_cell(i), grid.middle(c), p);
  }

  // Cells without triangles count whole, the others by eight points.
  double enclosed_volume() const {
    double in_cells = inside.between(Int3(0), grid.size);
    for (int z = 0; z < grid.size.z; ++z)
      for (int y = 0; y < grid.size.y; ++y)
        for (int x = 0; x < grid.size.x; ++x) {
          if (is_empty(grid.index({x, y, z}))) continue;
          for (int k = 0; k < 8; ++k) {
            const Vec3 offset = 0.5 * Vec3(k & 1, k >> 1 & 1, k >> 2 & 1) - 0.25;
            in_cells += 0.125 * winds(winding_at(grid.middle({x, y, z}) + grid.cell * offset));
          }
        }
    return in_cells * grid.cell * grid.cell * grid.cell;
  }

  std::uint64_t contains_each(const PointBlock& block, std::uint64_t some) const;
  std::uint64_t contains_some(const PointBlock& block, std::uint64_t some,
                              std::uint64_t free) const;
  std::optional<TriangleGrid::Touched> touched(const PointBlock& centers, const Vec3& half) const;

  MeshSupportReport report;
  Box3 box;
  CellGrid grid;
  bool has_holes;
  TriangleGrid surface;
  std::vector<float> winding;  // per cell, at its middle
  CellSums inside;             // cells that are wholly inside
  CellSums outside;
};

MeshSupport::MeshSupport(const TriangleMesh& mesh, Job* job) {
  constexpr const char* kNoVolume =
      "the mesh encloses no volume; give a closed surface, or one with small holes only";
  const RepairedMesh repaired = repair(mesh);
  if (repaired.triangles.empty()) throw input_error(kNoVolume);
  impl_ = std::make_unique<const Impl>(repaired, job);
  const double longest = impl_->box.longest_side();
  if (impl_->report.volume <= 1e-12 * longest * longest * longest) throw input_error(kNoVolume);
}

MeshSupport::~MeshSupport() = default;

bool MeshSupport::contains(const Vec3& p) const {
  return impl_->box.contains(p) && winds(impl_->winding_at(p));
}

// Answers for some points of a block, one by one.
std::uint64_t MeshSupport::Impl::contains_each(const PointBlock& block, std::uint64_t some) const {
  std::array<std::size_t, kBlockPoints> cells;
  for (std::uint64_t rest = some; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    cells[static_cast<std::size_t>(i)] = grid.index(grid.cell_of(block.point(i)));
  }
  // Points that share a cell share its middle, and which side of each triangle that lies on.
  std::array<Vec3, kBlockPoints> points;
  std::array<double, kBlockPoints> windings;
  std::uint64_t bits = 0;
  while (some != 0) {
    const std::size_t cell = cells[static_cast<std::size_t>(std::countr_zero(some))];
    std::uint64_t shared = 0;
    std::size_t count = 0;
    for (std::uint64_t rest = some; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      if (cells[static_cast<std::size_t>(i)] != cell) continue;
      shared |= std::uint64_t{1} << i;
      points[count++] = block.point(i);
    }
    some &= ~shared;
    std::fill_n(windings.begin(), count, double{winding[cell]});
    if (!is_empty(cell))
      surface.add_crossings(surface.in_cell(cell), grid.middle(grid.cell_of(points[0])),
                            std::span(points).first(count), std::span(windings).first(count));
    for (std::size_t k = 0; shared != 0; ++k, shared &= shared - 1)
      bits |= std::uint64_t{box.contains(points[k]) && winds(windings[k])}
              << std::countr_zero(shared);
  }
  return bits;
}

// The same where no triangle touches the boxes around `free` points, which meet: neighbors among
// them are alike.
std::uint64_t MeshSupport::Impl::contains_some(const PointBlock& block, std::uint64_t some,
                                               std::uint64_t free) const {
  std::uint64_t bits = contains_each(block, some & ~free);
  for (std::uint64_t left = free; left != 0;) {
    const std::uint64_t one = left & (~left + 1), alike = connected(one, left);
    if (contains_each(block, one) != 0) bits |= alike;
    left &= ~alike;
  }
  return bits & some;
}

// Triangles near boxes around the points of a block; none if that is no help: many, or a mesh with
// holes, which winds around points differently without a triangle between them.
std::optional<TriangleGrid::Touched> MeshSupport::Impl::touched(const PointBlock& centers,
                                                                const Vec3& half) const {
  constexpr int kFewCells = 64;
  const Box3 around =
      centers.box_around(half + 0.5 * (glm::abs(centers.step[0]) + glm::abs(centers.step[1]) +
                                       glm::abs(centers.step[2])));
  const Int3 first = grid.cell_of(around.min), last = grid.cell_of(around.max);
  const Int3 size = last - first + 1;
  if (has_holes || size.x * size.y * size.z > kFewCells) return std::nullopt;
  std::vector<std::uint32_t> triangles;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const auto listed = surface.in_cell(grid.index({x, y, z}));
        triangles.insert(triangles.end(), listed.begin(), listed.end());
      }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return surface.touched(triangles, centers, half);
}

std::uint64_t MeshSupport::contains_block(const PointBlock& block) const {
  const auto touched = impl_->touched(block, Vec3(0));
  return impl_->contains_some(block, ~std::uint64_t{0}, touched ? ~touched->meeting : 0);
}

BoxState MeshSupport::classify(const Box3& query) const {
  const Impl& m = *impl_;
  const Box3 part{glm::max(query.min, m.box.min), glm::min(query.max, m.box.max)};
  if (part.empty()) return BoxState::outside;
  const Int3 a = m.grid.cell_of(part.min), b = m.grid.cell_of(part.max) + 1;
  const Int3 span = b - a;
  const auto all = static_cast<std::uint32_t>(span.x * span.y * span.z);
  if (m.outside.between(a, b) == all) return BoxState::outside;
  const bool reaches_out = part.min != query.min || part.max != query.max;
  if (!reaches_out && m.inside.between(a, b) == all) return BoxState::inside;
  return BoxState::mixed;
}

BlockStates MeshSupport::classify_block(const PointBlock& centers, const Vec3& half) const {
  const auto touched = impl_->touched(centers, half);
  if (!touched) return Support::classify_block(centers, half);
  const std::uint64_t alike = ~touched->boxes;
  BlockStates states;
  states.inside = impl_->contains_some(centers, alike, ~touched->meeting);
  states.outside = alike & ~states.inside;
  const Box3 &box = impl_->box, around = centers.box_around(half);
  if (box.contains(around.min) && box.contains(around.max)) return states;
  for (int i = 0; i < kBlockPoints; ++i)
    if (!box.contains(centers.point(i) - half) || !box.contains(centers.point(i) + half))
      states.inside &= ~(std::uint64_t{1} << i);
  return states;
}

Box3 MeshSupport::bounds() const { return impl_->box; }

const MeshSupportReport& MeshSupport::report() const { return impl_->report; }

}  // namespace talus
