#include "talus/terrain/ground_skirt.h"

#include <algorithm>
#include <array>
#include <limits>

namespace talus::ground {
namespace {

constexpr std::int32_t kNoLevel = std::numeric_limits<std::int32_t>::max();

// The part of a side between two neighboring lines, cell by cell. Corners and edges of a cell go
// counter-clockwise seen from outside: corners lower left, lower right, upper right, upper left;
// edges lower, right, upper, left.
struct StripCell {
  std::int32_t level;
  std::array<bool, 4> inside;
};

// Calls `use(cell)` for the cells in which a strip's lines differ or cross the surface, upward.
void for_each_cut_cell(std::span<const Crossing> left, std::span<const Crossing> right,
                       bool inside_below, auto&& use) {
  const std::array lines{left, right};
  std::array<std::size_t, 2> next{};
  const auto level_of = [&](std::size_t l) {
    return next[l] < lines[l].size() ? lines[l][next[l]].level : kNoLevel;
  };
  std::array<bool, 2> lower{inside_below, inside_below};
  for (std::int32_t level = std::min(level_of(0), level_of(1)); level != kNoLevel;) {
    std::array<bool, 2> upper = lower;
    for (std::size_t l = 0; l < 2; ++l)
      if (level_of(l) == level) {
        upper[l] = !upper[l];
        ++next[l];
      }
    use(StripCell{level, {lower[0], lower[1], upper[1], upper[0]}});
    lower = upper;
    level = lower[0] == lower[1] ? std::min(level_of(0), level_of(1)) : level + 1;
  }
}

// The lines along the border, counter-clockwise seen from above.
class Border {
 public:
  explicit Border(const Lattice& lattice) : lattice_(lattice) {}

  int width() const { return lattice_.i_end - lattice_.i_begin; }
  int depth() const { return lattice_.j_end - lattice_.j_begin; }
  int count() const { return 2 * (width() + depth()); }

  struct Place {
    int i, j;
  };
  // Of a line; any m, wrapped.
  Place place(int m) const {
    m = (m + count()) % count();
    if (m <= width()) return {lattice_.i_begin + m, lattice_.j_begin};
    m -= width();
    if (m <= depth()) return {lattice_.i_end, lattice_.j_begin + m};
    m -= depth();
    if (m <= width()) return {lattice_.i_end - m, lattice_.j_end};
    return {lattice_.i_begin, lattice_.j_end - (m - width())};
  }

 private:
  Lattice lattice_;
};

// A line of a side, with the vertices on it that the side needs: its lower end, the inner corners
// of cells that the surface cuts, the surface's own crossings.
struct Post {
  std::uint32_t foot = 0;
  std::vector<std::int32_t> levels;
  std::uint32_t first_level = 0;  // vertex
  std::uint32_t first_crossing = 0;
};

class SkirtMaker {
 public:
  SkirtMaker(const Surface& surface, double depth, Material material, TriangleMesh& mesh)
      : surface_(surface), border_(surface.lattice()), mesh_(mesh) {
    shares_[static_cast<std::size_t>(material)] = 255;
    const Lattice& lattice = surface.lattice();
    std::int32_t lowest = kNoLevel;
    for (int j = lattice.j_begin; j <= lattice.j_end; ++j)
      for (int i = lattice.i_begin; i <= lattice.i_end; ++i)
        if (const auto line = surface.line(i, j); !line.empty())
          lowest = std::min(lowest, line[0].level);
    bottom_ = static_cast<float>(lowest * lattice.cell.z - depth);
  }

  void add_sides() {
    add_side(0, border_.width(), Vec3f(0, -1, 0));
    add_side(border_.width(), border_.depth(), Vec3f(1, 0, 0));
    add_side(border_.width() + border_.depth(), border_.width(), Vec3f(0, 1, 0));
    add_side(2 * border_.width() + border_.depth(), border_.depth(), Vec3f(-1, 0, 0));
  }

  // A fan around its middle.
  void add_base() {
    normal_ = Vec3f(0, 0, -1);
    const Lattice& lattice = surface_.lattice();
    const Vec3f low = foot({lattice.i_begin, lattice.j_begin});
    const Vec3f high = foot({lattice.i_end, lattice.j_end});
    const std::uint32_t middle = add_vertex(0.5f * (low + high));
    const std::uint32_t first = middle + 1;
    const auto count = static_cast<std::uint32_t>(border_.count());
    for (int m = 0; m < border_.count(); ++m) add_vertex(foot(border_.place(m)));
    for (std::uint32_t m = 0; m < count; ++m)
      mesh_.triangles.emplace_back(middle, first + (m + 1) % count, first + m);
  }

 private:
  Vec3f foot(const Border::Place& p) const {
    Vec3f position = surface_.lattice().mesh_point(Vec3(p.i, p.j, 0));
    position.z = bottom_;
    return position;
  }

  std::uint32_t add_vertex(const Vec3f& position) {
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal_);
    mesh_.shares.push_back(shares_);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  std::span<const Crossing> line(int m) const {
    const Border::Place p = border_.place(m);
    return surface_.line(p.i, p.j);
  }

  // Of the strip between lines m and m + 1.
  void for_each_cut_cell(int m, auto&& use) const {
    ground::for_each_cut_cell(line(m), line(m + 1), surface_.inside_below(), use);
  }

  // Both strips beside the line ask for corners, on whatever sides they are, so that neighbors fit.
  Post make_post(int m) {
    Post post;
    const auto collect = [&](int left, std::size_t lower_corner, std::size_t upper_corner) {
      for_each_cut_cell(left, [&](const StripCell& cell) {
        if (cell.inside[lower_corner]) post.levels.push_back(cell.level);
        if (cell.inside[upper_corner]) post.levels.push_back(cell.level + 1);
      });
    };
    collect(m - 1, 1, 2);
    collect(m, 0, 3);
    std::sort(post.levels.begin(), post.levels.end());
    post.levels.erase(std::unique(post.levels.begin(), post.levels.end()), post.levels.end());

    const Border::Place p = border_.place(m);
    if (surface_.inside_below()) post.foot = add_vertex(foot(p));
    post.first_level = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const std::int32_t level : post.levels)
      add_vertex(surface_.lattice().mesh_point(Vec3(p.i, p.j, level)));
    post.first_crossing = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::uint32_t rim = surface_.first_vertical(p.i, p.j);
    for (std::uint32_t c = 0; c < surface_.line(p.i, p.j).size(); ++c)
      add_vertex(mesh_.positions[rim + c]);
    return post;
  }

  void add_side(int first, int count, const Vec3f& normal) {
    normal_ = normal;
    Post left = make_post(first);
    for (int m = first; m < first + count; ++m) {
      Post right = make_post(m + 1);
      add_strip(m, left, right);
      left = std::move(right);
    }
  }

  // The surface's first vertex on the edges between a strip's lines.
  std::uint32_t first_across(int m) const {
    const Border::Place a = border_.place(m), b = border_.place(m + 1);
    const int i = std::min(a.i, b.i), j = std::min(a.j, b.j);
    return a.j == b.j ? surface_.first_along_x(i, j) : surface_.first_along_y(i, j);
  }

  void add_strip(int m, const Post& left, const Post& right) {
    std::uint32_t across = first_across(m);  // the next such vertex of the surface
    std::uint32_t lower_edge = 0;            // its copy at the lower edge of the next cell
    std::array<std::uint32_t, 2> crossing{left.first_crossing, right.first_crossing};
    std::int32_t whole_from = std::numeric_limits<std::int32_t>::min();
    bool whole = surface_.inside_below();
    for_each_cut_cell(m, [&](const StripCell& cell) {
      if (whole) add_whole(left, right, whole_from, cell.level);
      const auto& in = cell.inside;
      const std::uint32_t upper_edge = in[2] != in[3] ? add_vertex(mesh_.positions[across++]) : 0;
      const std::array edges{lower_edge, in[1] != in[2] ? crossing[1]++ : 0, upper_edge,
                             in[0] != in[3] ? crossing[0]++ : 0};
      add_cut(cell, left, right, edges);
      lower_edge = upper_edge;
      whole = in[2] && in[3];
      whole_from = cell.level + 1;
    });
  }

  static std::uint32_t vertex_at(const Post& post, std::int32_t level) {
    const auto place = std::lower_bound(post.levels.begin(), post.levels.end(), level);
    return post.first_level + static_cast<std::uint32_t>(place - post.levels.begin());
  }

  // What is inside a cell: a polygon, or the corners that stand alone at the ends of a diagonal.
  void add_cut(const StripCell& cell, const Post& left, const Post& right,
               const std::array<std::uint32_t, 4>& edges) {
    const auto corner = [&](std::size_t c) {
      return vertex_at(c == 0 || c == 3 ? left : right, cell.level + (c >= 2 ? 1 : 0));
    };
    const auto& in = cell.inside;
    const bool diagonal = in[0] == in[2] && in[1] == in[3] && in[0] != in[1];
    std::array<std::uint32_t, 6> polygon;
    std::size_t size = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      if (diagonal) {
        if (in[c]) mesh_.triangles.emplace_back(edges[(c + 3) % 4], corner(c), edges[c]);
        continue;
      }
      if (in[c]) polygon[size++] = corner(c);
      if (in[c] != in[(c + 1) % 4]) polygon[size++] = edges[c];
    }
    for (std::size_t k = 2; k < size; ++k)
      mesh_.triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
  }

  // Cells that are all inside, from one level to another, or from the foot.
  void add_whole(const Post& left, const Post& right, std::int32_t from, std::int32_t to) {
    const auto chain = [&](const Post& post) {
      std::vector<std::uint32_t> vertices;
      if (from == std::numeric_limits<std::int32_t>::min()) vertices.push_back(post.foot);
      for (std::size_t l = 0; l < post.levels.size(); ++l)
        if (post.levels[l] >= from && post.levels[l] <= to)
          vertices.push_back(post.first_level + static_cast<std::uint32_t>(l));
      return vertices;
    };
    const std::vector<std::uint32_t> a = chain(left), b = chain(right);
    for (std::size_t i = 0, j = 0; i + 1 < a.size() || j + 1 < b.size();) {
      const bool raise_left =
          j + 1 == b.size() ||
          (i + 1 < a.size() && mesh_.positions[a[i + 1]].z <= mesh_.positions[b[j + 1]].z);
      mesh_.triangles.emplace_back(a[i], b[j], raise_left ? a[i + 1] : b[j + 1]);
      ++(raise_left ? i : j);
    }
  }

  const Surface& surface_;
  Border border_;
  TriangleMesh& mesh_;
  MaterialShares shares_{};
  float bottom_ = 0;
  Vec3f normal_{0};
};

}  // namespace

void add_skirt(const Surface& surface, double depth, bool base, Material material,
               TriangleMesh& mesh) {
  SkirtMaker maker(surface, depth, material, mesh);
  maker.add_sides();
  if (base && surface.inside_below()) maker.add_base();
}

// Each post belongs to one side, at a corner to two. A cut cell asks two posts for two corners
// each, has one edge across of its own and at most three triangles; above a foot or a corner is at
// most one triangle of a whole run on either side.
SkirtSize largest_skirt(const Surface& surface) {
  const Border border(surface.lattice());
  SkirtSize size{1, 0};
  for (int m = 0; m < border.count(); ++m) {
    const auto line = [&](int n) {
      const Border::Place p = border.place(n);
      return surface.line(p.i, p.j);
    };
    std::size_t cells = 0;
    for_each_cut_cell(line(m), line(m + 1), surface.inside_below(),
                      [&](const StripCell&) { ++cells; });
    size.vertices += 2 * (2 + line(m).size() + 5 * cells);
    size.triangles += 3 + (3 + 2 * 4) * cells;
  }
  return size;
}

}  // namespace talus::ground
