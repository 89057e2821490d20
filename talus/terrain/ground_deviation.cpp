#include "talus/terrain/ground_deviation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "talus/base/parallel.h"

namespace talus::ground {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-5;       // by how much rounding moves vertices, in cells
constexpr double kLostDistance = 2;  // in sigmas: rounding off an edge moves a top by less than one
constexpr double kHighShare = 0.99;  // of the columns that `Deviation::p99` bounds
constexpr double kHalfFull = 1e-6;   // of the field, but for rounding

// Columns along one axis, and where their middles are in the mesh's frame.
struct Middles {
  double columns_per_cell, cell;  // metres
  int center;
  int begin = 0, end = 0;

  // Those between two lines of the lattice.
  Middles between(int line, int line_end) const {
    Middles part = *this;
    part.begin = static_cast<int>(std::ceil(line * columns_per_cell - 0.5));
    part.end = static_cast<int>(std::ceil(line_end * columns_per_cell - 0.5));
    return part;
  }
  // Those in a closed interval of the mesh's frame.
  Middles within(double low, double high) const {
    const double columns_per_metre = columns_per_cell / cell;
    const double shift = center * columns_per_cell - 0.5;
    const auto number = [&](double place) { return place * columns_per_metre + shift; };
    Middles part = *this;
    part.begin = std::max(begin, static_cast<int>(std::ceil(number(low) - kTiny)));
    part.end = std::min(end, static_cast<int>(std::floor(number(high) + kTiny)) + 1);
    return part;
  }
  double place(int column) const { return ((column + 0.5) / columns_per_cell - center) * cell; }
  std::size_t count() const { return static_cast<std::size_t>(end - begin); }
};

// The columns between two rows of lines.
class Row {
 public:
  Row(const Lattice& lattice, const TerrainField& field, int j)
      : xs_(Middles{lattice.columns_x, lattice.cell.x, lattice.center_i}.between(lattice.i_begin,
                                                                                 lattice.i_end)),
        ys_(Middles{lattice.columns_y, lattice.cell.y, lattice.center_j}.between(j, j + 1)) {
    tops_.reserve(xs_.count() * ys_.count());
    for (int y = ys_.begin; y < ys_.end; ++y)
      for (int x = xs_.begin; x < xs_.end; ++x)
        tops_.push_back(top(field, field.terrain().column(x, y), lattice.level_zero));
    heights_.assign(tops_.size(), kInfinity);
    distances_.assign(tops_.size(), kInfinity);
  }

  // Measures the triangle from the columns whose middles it covers: the height between, and the
  // distance to its plane.
  void measure(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto area = [](const Vec3& p, const Vec3& q, double x, double y) {
      return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    };
    const double whole = area(a, b, c.x, c.y);
    if (std::abs(whole) < 1e-9 * xs_.cell * ys_.cell) return;
    const double share = 1 / whole;
    const Vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const Middles xs = xs_.within(low.x, high.x), ys = ys_.within(low.y, high.y);
    for (int y = ys.begin; y < ys.end; ++y)
      for (int x = xs.begin; x < xs.end; ++x) {
        const double px = xs.place(x), py = ys.place(y);
        const double wa = share * area(b, c, px, py), wb = share * area(c, a, px, py);
        const double wc = 1 - wa - wb;
        if (std::min({wa, wb, wc}) < -kTiny) continue;
        const std::size_t i = static_cast<std::size_t>(y - ys_.begin) * xs_.count() +
                              static_cast<std::size_t>(x - xs_.begin);
        const double height = std::abs(wa * a.z + wb * b.z + wc * c.z - tops_[i]);
        if (height >= heights_[i]) continue;
        heights_[i] = height;
        distances_[i] = height * std::abs(whole) / glm::length(glm::cross(b - a, c - a));
      }
  }

  // Distances of the columns that have a top and triangles.
  std::vector<float> distances() const {
    std::vector<float> found;
    for (const double distance : distances_)
      if (std::isfinite(distance)) found.push_back(static_cast<float>(distance));
    return found;
  }

  // Takes out columns with a top but no triangle near it, and returns how many they are. Where just
  // the edge of something thick is cut off, the column stays.
  std::size_t take_lost(const TerrainField& field, double level_zero) {
    const TerrainGrid& grid = field.terrain().grid();
    std::size_t count = 0, i = 0;
    for (int y = ys_.begin; y < ys_.end; ++y)
      for (int x = xs_.begin; x < xs_.end; ++x, ++i) {
        if (!std::isfinite(tops_[i]) || heights_[i] <= kLostDistance * field.sigma()) continue;
        const Vec3 under_top(grid.center(x, y), tops_[i] + level_zero * grid.step - field.sigma());
        const bool is_lost = field.value(under_top) < kHalfFull;
        // The field's surface, if not the mesh's triangles, passes between there and the top.
        distances_[i] = is_lost ? kInfinity : std::min(distances_[i], field.sigma());
        count += is_lost;
      }
    return count;
  }

 private:
  // In the mesh's frame; -infinity if there is nothing of the materials.
  static double top(const TerrainField& field, std::span<const Layer> column, double level_zero) {
    const TerrainGrid& grid = field.terrain().grid();
    const auto height = [&](Steps z) { return (z - level_zero) * grid.step; };
    double result = field.materials().contains(Material::bedrock) ? height(grid.floor) : -kInfinity;
    for (const Layer& layer : column)
      if (field.materials().contains(layer.material())) result = height(layer.top());
    return result;
  }

  Middles xs_, ys_;
  std::vector<double> tops_, heights_, distances_;
};

}  // namespace

Deviation deviation_from_tops(const Surface& surface, const TerrainField& field,
                              const TriangleMesh& mesh) {
  const Lattice& lattice = surface.lattice();
  std::vector<std::vector<float>> rows(lattice.line_count_y() - 1);
  std::vector<std::size_t> lost(rows.size());
  parallel_for(rows.size(), [&](std::size_t r) {
    const int j = lattice.j_begin + static_cast<int>(r);
    Row row(lattice, field, j);
    for (const Triangle& t : surface.triangles(mesh, j))
      row.measure(Vec3(mesh.positions[t.x]), Vec3(mesh.positions[t.y]), Vec3(mesh.positions[t.z]));
    lost[r] = row.take_lost(field, lattice.level_zero);
    rows[r] = row.distances();
  });

  Deviation deviation{.columns_lost = std::accumulate(lost.begin(), lost.end(), std::uint64_t{0})};
  std::vector<float> all;
  for (const std::vector<float>& row : rows) all.insert(all.end(), row.begin(), row.end());
  if (all.empty()) return deviation;
  deviation.mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  deviation.max = *std::max_element(all.begin(), all.end());
  const double rank = std::ceil(kHighShare * static_cast<double>(all.size()));
  const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(all.begin(), p99, all.end());
  deviation.p99 = *p99;
  return deviation;
}

}  // namespace talus::ground
