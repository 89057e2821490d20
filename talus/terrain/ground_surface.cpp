#include "talus/terrain/ground_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "talus/base/parallel.h"
#include "talus/mesh/cell_triangles.h"
#include "talus/terrain/field_sampler.h"
#include "talus/terrain/visible_shares.h"

namespace talus::ground {
namespace {

// Vertices keep this far from the corners, as a share of their edge, so that no two coincide.
constexpr float kMargin = 1.0f / 1024;

float kept_from_corners(double fraction) {
  return std::clamp(static_cast<float>(fraction), kMargin, 1 - kMargin);
}

// Calls `use(level)` for the levels at which one of two lines is inside and the other outside.
void for_each_difference(std::span<const Crossing> a, std::span<const Crossing> b, auto&& use) {
  bool differ = false;
  std::int32_t level = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const std::int32_t next =
        std::min(i < a.size() ? a[i].level : std::numeric_limits<std::int32_t>::max(),
                 j < b.size() ? b[j].level : std::numeric_limits<std::int32_t>::max());
    if (differ)
      for (std::int32_t k = level + 1; k <= next; ++k) use(k);
    for (; i < a.size() && a[i].level == next; ++i) differ = !differ;
    for (; j < b.size() && b[j].level == next; ++j) differ = !differ;
    level = next;
  }
}

// Calls `use(level, positive)` for the cells that the surface crosses between four lines, upward.
// Bit c of `positive` tells whether corner c is inside; `lines` are in the order of the lower
// corners.
void for_each_cell(const std::array<std::span<const Crossing>, 4>& lines, bool inside_below,
                   auto&& use) {
  std::array<std::size_t, 4> next{};
  const auto next_level = [&] {
    std::int32_t level = std::numeric_limits<std::int32_t>::max();
    for (std::size_t l = 0; l < 4; ++l)
      if (next[l] < lines[l].size()) level = std::min(level, lines[l][next[l]].level);
    return level;
  };
  unsigned lower = inside_below ? 15 : 0;
  for (std::int32_t level = next_level(); level != std::numeric_limits<std::int32_t>::max();) {
    unsigned upper = lower;
    for (std::size_t l = 0; l < 4; ++l)
      if (next[l] < lines[l].size() && lines[l][next[l]].level == level) {
        upper ^= 1u << l;
        ++next[l];
      }
    use(level, static_cast<std::uint8_t>(lower | upper << 4));
    lower = upper;
    level = lower == 0 || lower == 15 ? next_level() : level + 1;
  }
}

// The numbers of the vertices on a cell's edges, for the cells between four lines upward.
class CellVertices {
 public:
  CellVertices(const Surface& surface, int i, int j)
      : x_{surface.first_along_x(i, j), surface.first_along_x(i, j + 1)},
        y_{surface.first_along_y(i, j), surface.first_along_y(i + 1, j)},
        z_{surface.first_vertical(i, j), surface.first_vertical(i + 1, j),
           surface.first_vertical(i, j + 1), surface.first_vertical(i + 1, j + 1)} {}

  // Of the next cell, by its edges' order.
  std::array<std::uint32_t, 12> next(unsigned positive) {
    const auto differ = [&](int a, int b) { return (positive >> a ^ positive >> b) & 1u; };
    const std::array<std::uint32_t, 2> x = x_, y = y_;
    const std::array<std::uint32_t, 4> z = z_;
    x_ = {x[0] + differ(0, 1), x[1] + differ(2, 3)};
    y_ = {y[0] + differ(0, 2), y[1] + differ(1, 3)};
    for (int l = 0; l < 4; ++l) z_[static_cast<std::size_t>(l)] += differ(l, l + 4);
    return {x[0], x[1], x_[0], x_[1], y[0], y[1], y_[0], y_[1], z[0], z[1], z[2], z[3]};
  }

 private:
  std::array<std::uint32_t, 2> x_, y_;
  std::array<std::uint32_t, 4> z_;
};

// Makes ready what the vertices of some rows of lines ask for.
void load_rows(FieldSampler& sampler, const Lattice& lattice, int j, int j_end) {
  const ColumnCover west = sampler.cover_x(lattice.i_begin * lattice.columns_x);
  const ColumnCover east = sampler.cover_x(lattice.i_end * lattice.columns_x);
  const ColumnCover south = sampler.cover_y(j * lattice.columns_y);
  const ColumnCover north = sampler.cover_y(std::min(j_end, lattice.j_end) * lattice.columns_y);
  sampler.load({west.begin - 1, south.begin - 1, east.end + 1, north.end + 1});
}

// Calls `body(j, j_end)` for bands of rows of lines in parallel, progress from `begin` to `end`.
void for_each_band(const Lattice& lattice, Job* job, double begin, double end, auto&& body) {
  constexpr int kRows = 8;
  const int rows = lattice.j_end + 1 - lattice.j_begin;
  std::atomic<int> done = 0;
  parallel_for(static_cast<std::size_t>((rows + kRows - 1) / kRows), [&](std::size_t band) {
    const int j = lattice.j_begin + kRows * static_cast<int>(band);
    const int j_end = std::min(j + kRows, lattice.j_end + 1);
    body(j, j_end);
    const double share = static_cast<double>(done += j_end - j) / rows;
    report_progress(job, "ground mesh", begin + (end - begin) * share);
  });
}

}  // namespace

Surface::Surface(const TerrainField& field, const Lattice& lattice, Job* job)
    : field_(&field),
      lattice_(lattice),
      inside_below_(field.materials().contains(Material::bedrock)),
      rows_(lattice.line_count_y() + 1) {
  for_each_band(lattice_, job, 0, 0.2, [&](int j, int j_end) {
    FieldSampler sampler(*field_);
    load_rows(sampler, lattice_, j, j_end);
    for (; j < j_end; ++j) find_crossings(j, sampler);
  });
  for_each_band(lattice_, job, 0.2, 0.3, [&](int j, int j_end) {
    for (; j < j_end; ++j) count(j);
  });
  number_rows();
}

// Two crossings of one edge leave its ends alike and cancel.
void Surface::find_crossings(int j, FieldSampler& sampler) {
  const std::uint64_t samples_before = sampler.samples();
  Row& row = rows_[static_cast<std::size_t>(j - lattice_.j_begin)];
  row.lines.resize(lattice_.line_count_x() + 1);
  std::vector<Crossing> crossings;
  crossings.reserve(2 * row.lines.size());
  for (int i = lattice_.i_begin; i <= lattice_.i_end; ++i) {
    const std::size_t first = crossings.size();
    row.lines[static_cast<std::size_t>(i - lattice_.i_begin)].first_crossing =
        static_cast<std::uint32_t>(first);
    for (const double z :
         sampler.vertical_crossings(i * lattice_.columns_x, j * lattice_.columns_y)) {
      const double place = (z - lattice_.level_zero) / lattice_.steps;
      const auto level = static_cast<std::int32_t>(std::floor(place));
      if (crossings.size() > first && crossings.back().level == level)
        crossings.pop_back();
      else
        crossings.push_back({level, kept_from_corners(place - level)});
    }
  }
  row.lines.back().first_crossing = static_cast<std::uint32_t>(crossings.size());
  row.crossings.assign(crossings.begin(), crossings.end());
  row.samples = sampler.samples() - samples_before;
}

// Vertices are numbered line by line: those on it, those toward i + 1, those toward j + 1.
void Surface::count(int j) {
  Row& row = rows_[static_cast<std::size_t>(j - lattice_.j_begin)];
  std::uint64_t vertices = 0;
  for (int i = lattice_.i_begin; i <= lattice_.i_end; ++i) {
    Line& here = row.lines[static_cast<std::size_t>(i - lattice_.i_begin)];
    here.first_vertex = static_cast<std::uint32_t>(vertices);
    vertices += line(i, j).size();
    if (i < lattice_.i_end)
      for_each_difference(line(i, j), line(i + 1, j), [&](int) { ++vertices; });
    here.first_along_y = static_cast<std::uint32_t>(vertices);
    if (j < lattice_.j_end)
      for_each_difference(line(i, j), line(i, j + 1), [&](int) { ++vertices; });
    if (i < lattice_.i_end && j < lattice_.j_end)
      for_each_cell({line(i, j), line(i + 1, j), line(i, j + 1), line(i + 1, j + 1)}, inside_below_,
                    [&](int, std::uint8_t positive) {
                      ++row.cells;
                      row.triangles += cell_triangles(positive).size() / 3;
                    });
  }
  row.vertices = vertices;
}

void Surface::number_rows() {
  for (std::size_t r = 1; r < rows_.size(); ++r) {
    const Row& before = rows_[r - 1];
    rows_[r].first_vertex = before.first_vertex + before.vertices;
    rows_[r].first_triangle = before.first_triangle + before.triangles;
    surface_cells_ += before.cells;
    field_samples_ += before.samples;
  }
  check_vertex_count(vertex_count());
}

std::span<const Crossing> Surface::line(int i, int j) const {
  const Line* const here = &at(i, j);
  return std::span(row(j).crossings)
      .subspan(here->first_crossing, (here + 1)->first_crossing - here->first_crossing);
}

std::uint32_t Surface::first_vertical(int i, int j) const {
  return static_cast<std::uint32_t>(row(j).first_vertex + at(i, j).first_vertex);
}
std::uint32_t Surface::first_along_x(int i, int j) const {
  return first_vertical(i, j) + static_cast<std::uint32_t>(line(i, j).size());
}
std::uint32_t Surface::first_along_y(int i, int j) const {
  return static_cast<std::uint32_t>(row(j).first_vertex + at(i, j).first_along_y);
}

std::span<const Triangle> Surface::triangles(const TriangleMesh& mesh, int j) const {
  return std::span(mesh.triangles).subspan(row(j).first_triangle, row(j).triangles);
}

std::size_t Surface::bytes() const {
  std::size_t sum = rows_.capacity() * sizeof(Row);
  for (const Row& row : rows_)
    sum += row.crossings.capacity() * sizeof(Crossing) + row.lines.capacity() * sizeof(Line);
  return sum;
}

// Makes the vertices of lines and the triangles between them, for a band of rows.
struct Surface::Filler {
  const Surface& surface;
  TriangleMesh& mesh;
  FieldSampler sampler{*surface.field_};
  VisibleShares shares{sampler};

  // `outward` points along the edge, from its inner end to its outer one.
  void set_vertex(std::size_t vertex, const Vec3& p, const Vec3& outward) {
    const Vec3 g = surface.lattice_.field_point(p);
    mesh.positions[vertex] = surface.lattice_.mesh_point(p);
    mesh.normals[vertex] = Vec3f(sampler.normal(g).value_or(outward));
    mesh.shares[vertex] = shares.at(g);
  }

  void add_vertices(int i, int j) {
    const std::span<const Crossing> here = surface.line(i, j);
    std::size_t vertex = surface.first_vertical(i, j);
    bool inside = surface.inside_below_;
    for (const Crossing& crossing : here) {
      set_vertex(vertex++, Vec3(i, j, crossing.level + double{crossing.fraction}),
                 Vec3(0, 0, inside ? 1 : -1));
      inside = !inside;
    }
    const Lattice& lattice = surface.lattice_;
    const auto add_along = [&](int axis, std::span<const Crossing> there) {
      for_each_difference(here, there, [&](int level) {
        const Vec3 corner(i, j, level);
        const auto above =
            std::lower_bound(here.begin(), here.end(), level,
                             [](const Crossing& crossing, int k) { return crossing.level < k; });
        const bool corner_inside = surface.inside_below_ != ((above - here.begin()) % 2 != 0);
        const double share = sampler.horizontal_crossing(
            lattice.field_point(corner), axis, axis == 0 ? lattice.columns_x : lattice.columns_y);
        Vec3 p = corner, outward(0);
        p[axis] += double{kept_from_corners(share)};
        outward[axis] = corner_inside ? 1 : -1;
        set_vertex(vertex++, p, outward);
      });
    };
    if (i < lattice.i_end) add_along(0, surface.line(i + 1, j));
    if (j < lattice.j_end) add_along(1, surface.line(i, j + 1));
  }

  void add_triangles(int i, int j, std::size_t& triangle) {
    CellVertices vertices(surface, i, j);
    for_each_cell({surface.line(i, j), surface.line(i + 1, j), surface.line(i, j + 1),
                   surface.line(i + 1, j + 1)},
                  surface.inside_below_, [&](int, std::uint8_t positive) {
                    const std::array<std::uint32_t, 12> on_edge = vertices.next(positive);
                    const std::span<const std::uint8_t> edges = cell_triangles(positive);
                    for (std::size_t e = 0; e < edges.size(); e += 3)
                      mesh.triangles[triangle++] =
                          Triangle(on_edge[edges[e]], on_edge[edges[e + 1]], on_edge[edges[e + 2]]);
                  });
  }
};

void Surface::fill(TriangleMesh& mesh, Job* job) {
  // The first touch of so much memory takes its time.
  parallel_for(2, [&](std::size_t half) {
    if (half == 0) {
      mesh.triangles.resize(triangle_count());
    } else {
      mesh.positions.resize(vertex_count());
      mesh.normals.resize(vertex_count());
      mesh.shares.resize(vertex_count());
    }
  });
  std::atomic<std::uint64_t> samples = 0;
  for_each_band(lattice_, job, 0.3, 0.95, [&](int j, int j_end) {
    Filler filler{*this, mesh};
    load_rows(filler.sampler, lattice_, j, j_end);
    std::size_t triangle = row(j).first_triangle;
    for (; j < j_end; ++j)
      for (int i = lattice_.i_begin; i <= lattice_.i_end; ++i) {
        filler.add_vertices(i, j);
        if (i < lattice_.i_end && j < lattice_.j_end) filler.add_triangles(i, j, triangle);
      }
    samples += filler.sampler.samples();
  });
  field_samples_ += samples;
}

void check_vertex_count(std::uint64_t count) {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
  if (count > kMax)
    throw job_error(fmt::format(
        "the ground mesh has {} vertices, more than the {} that indices can tell apart; choose a "
        "larger cell or mesh it area by area",
        count, kMax));
}

}  // namespace talus::ground
