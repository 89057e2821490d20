#include "talus/terrain/field_sampler.h"

#include <glm/geometric.hpp>
#include <limits>

namespace talus {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

using Quad [[gnu::vector_size(32)]] = double;

// How much of [low, high] intervals fill. Without branches, which std::clamp would have: no two
// columns go alike.
double filled(auto&& intervals, double low, double high) {
  const auto kept = [&](double z) { return std::min(std::max(z, low), high); };
  double sum = 0;
  for (const auto& interval : intervals) sum += kept(interval.top) - kept(interval.bottom);
  return sum;
}

}  // namespace

FieldSampler::FieldSampler(const TerrainField& field)
    : field_(&field),
      grid_(field.terrain().grid()),
      sigma_columns_(field.sigma() / grid_.cell),
      sigma_steps_(field.sigma() / grid_.step) {}

ColumnCover FieldSampler::cover(double center, int columns) const {
  // Farther out nothing changes any more.
  const double reach = sigma_columns_ + 1;
  center = std::clamp(center, -reach, columns + reach);
  const double low = center - sigma_columns_, high = center + sigma_columns_;
  return {low, high, static_cast<int>(std::floor(low)), static_cast<int>(std::ceil(high))};
}

void FieldSampler::Block::begin(const ColumnArea& new_area) {
  area = new_area;
  intervals.clear();
  columns.clear();
  first.assign(1, 0);
}

// Faces between two columns ask for one beyond the cube.
void FieldSampler::need(const ColumnCover& xs, const ColumnCover& ys) {
  const ColumnArea needed{xs.begin - 1, ys.begin - 1, xs.end + 1, ys.end + 1};
  const ColumnArea& area = loaded_.area;
  if (needed.x_begin < area.x_begin || needed.x_end > area.x_end || needed.y_begin < area.y_begin ||
      needed.y_end > area.y_end)
    load(needed);
}

void FieldSampler::load(const ColumnArea& area) {
  loaded_.begin(area);
  layers_.clear();
  for (int y = area.y_begin; y < area.y_end; ++y)
    for (int x = area.x_begin; x < area.x_end; ++x) {
      layers_.push_back(
          field_->terrain().column(std::clamp(x, 0, grid_.nx - 1), std::clamp(y, 0, grid_.ny - 1)));
      add_intervals(layers_.back());
      loaded_.end_column(x);
    }
}

void FieldSampler::add_intervals(std::span<const Layer> layers) {
  const MaterialSet materials = field_->materials();
  bool inside = materials.contains(Material::bedrock);
  double bottom = -kEndless;
  const auto enter = [&](Material material, Steps z) {
    if (materials.contains(material) == inside) return;
    if (inside)
      loaded_.intervals.push_back({bottom, static_cast<double>(z)});
    else
      bottom = z;
    inside = !inside;
  };
  Steps top = grid_.floor;
  for (const Layer& layer : layers) {
    enter(layer.material(), top);
    top = layer.top();
  }
  enter(Material::air, top);
  if (inside) loaded_.intervals.push_back({bottom, kEndless});
}

double FieldSampler::value(const Vec3& g) {
  const ColumnCover xs = cover_x(g.x), ys = cover_y(g.y);
  need(xs, ys);
  ++samples_;
  const double low = g.z - sigma_steps_, high = g.z + sigma_steps_;
  double volume = 0;
  for (int y = ys.begin; y < ys.end; ++y) {
    double slice = 0;
    for (int x = xs.begin; x < xs.end; ++x) slice += xs.of(x) * filled(loaded_.at(x, y), low, high);
    volume += ys.of(y) * slice;
  }
  const double share = volume / (xs.length() * ys.length() * (high - low));
  return std::clamp(2 * share - 1, -1.0, 1.0);
}

void FieldSampler::weigh(const ColumnCover& cover, ColumnWeights& weights) {
  // The first and the last column that the interval touches.
  const int first = static_cast<int>(std::ceil(cover.low)) - 1;
  const int last = static_cast<int>(std::floor(cover.high));
  const double low_face = 1.0 / (cover.begin - first + 1);
  const double high_face = 1.0 / (last - cover.end + 2);
  weights.first = first;
  weights.length = cover.length();
  weights.weights.clear();
  for (int column = first; column <= last; ++column)
    weights.weights.push_back(
        {column >= cover.begin && column < cover.end ? cover.of(column) : 0.0,
         (column >= cover.end - 1 ? high_face : 0.0) - (column <= cover.begin ? low_face : 0.0)});
}

Vec3 FieldSampler::gradient(const Vec3& g) {
  approach(g);
  return gradient(g.z, sigma_steps_);
}

void FieldSampler::approach(const Vec3& g) {
  const ColumnCover xs = cover_x(g.x), ys = cover_y(g.y);
  need(xs, ys);
  weigh(xs, weights_x_);
  weigh(ys, weights_y_);
}

// The gradient above the place last approached, for a cube stretched along z, in the scale of the
// true one: df/dz as if z were not stretched.
Vec3 FieldSampler::gradient(double z, double half_height) {
  const double low = z - half_height, high = z + half_height;
  ++samples_;

  // Along x and y what the materials fill at the faces of the cube, each between two columns the
  // mean of both; along z what reaches through the upper face less what reaches through the lower,
  // half of what ends there.
  const Quad faces{high, high, low, low};
  Vec3 difference(0);
  for (std::size_t j = 0; j < weights_y_.weights.size(); ++j) {
    const ColumnWeight& row = weights_y_.weights[j];
    const auto [begin, end] = loaded_.row(weights_x_, weights_y_.first + static_cast<int>(j));
    double at_faces = 0, covered = 0;
    Quad passed{};
    for (std::uint32_t k = begin; k < end; ++k) {
      const Interval& i = loaded_.intervals[k];
      const ColumnWeight& column =
          weights_x_.weights[static_cast<std::size_t>(loaded_.columns[k] - weights_x_.first)];
      const double filled =
          std::min(std::max(i.top, low), high) - std::min(std::max(i.bottom, low), high);
      at_faces += column.face * filled;
      covered += column.cover * filled;
      const Quad ends{i.bottom, i.top, i.bottom, i.top}, half = 0.5 * column.cover - Quad{};
      passed += (faces > ends ? half : Quad{}) + (faces >= ends ? half : Quad{});
    }
    const double through = passed[0] - passed[1] - passed[2] + passed[3];
    difference += Vec3(row.cover * at_faces, row.face * covered, row.cover * through);
  }
  difference /= Vec3(weights_y_.length * (high - low), weights_x_.length * (high - low),
                     weights_x_.length * weights_y_.length * (half_height / sigma_steps_));
  return difference / field_->sigma();
}

// How far above and below the place last approached no layer nearby ends that faces down, or up if
// not `upward`.
double FieldSampler::room(double z, bool upward) const {
  double room = kEndless;
  for (std::size_t j = 0; j < weights_y_.weights.size(); ++j) {
    const auto [begin, end] = loaded_.row(weights_x_, weights_y_.first + static_cast<int>(j));
    for (std::uint32_t k = begin; k < end; ++k) {
      const Interval& interval = loaded_.intervals[k];
      room = std::min(room, std::abs((upward ? interval.bottom : interval.top) - z));
    }
  }
  return room;
}

std::optional<Vec3> FieldSampler::normal(const Vec3& g) {
  Vec3 inward = gradient(g);
  if (std::abs(inward.x) + std::abs(inward.y) > 0.5 * std::abs(inward.z)) {
    const double half_height = std::min(room(g.z, inward.z <= 0), kStretchMax * sigma_steps_);
    if (half_height > sigma_steps_) inward = gradient(g.z, half_height);
  }
  const double length = glm::length(inward);
  if (length * field_->sigma() < 1e-6) return std::nullopt;
  return -inward / length;
}

// Changes of A, upward.
void FieldSampler::gather_changes(double x, double y) {
  const ColumnCover xs = cover_x(x), ys = cover_y(y);
  need(xs, ys);
  const double whole = xs.length() * ys.length();
  changes_.clear();
  for (int j = ys.begin; j < ys.end; ++j)
    for (int i = xs.begin; i < xs.end; ++i) {
      const double area = xs.of(i) * ys.of(j) / whole;
      for (const Interval& interval : loaded_.at(i, j)) {
        if (interval.bottom > -kEndless) changes_.push_back({interval.bottom, area});
        if (interval.top < kEndless) changes_.push_back({interval.top, -area});
      }
    }
  std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
    return a.z != b.z ? a.z < b.z : a.area < b.area;
  });
}

std::span<const double> FieldSampler::vertical_crossings(double x, double y) {
  gather_changes(x, y);
  crossings_.clear();
  bool inside = field_->materials().contains(Material::bedrock);
  double area = inside ? 1 : 0, f = 0, slope = 0, z = 0;
  // The slope of f changes where a change of A enters the cube above and where it leaves it below.
  for (std::size_t entering = 0, leaving = 0; leaving < changes_.size();) {
    double next = changes_[leaving].z + sigma_steps_;
    const bool enters = entering < changes_.size() && changes_[entering].z - sigma_steps_ <= next;
    if (enters) next = changes_[entering].z - sigma_steps_;
    if (entering == leaving) {
      // A is the same all over the cube; rounding of slopes ends here.
      f = 2 * area - 1;
      slope = 0;
    }
    const double f_next = f + slope * (next - z);
    if ((f_next > kInsideAbove) != inside) {
      const double share = (kInsideAbove - f) / (f_next - f);
      crossings_.push_back(z + (next - z) * std::min(1.0, std::max(0.0, share)));
      inside = !inside;
    }
    f = f_next;
    z = next;
    const double change = enters ? changes_[entering].area : -changes_[leaving].area;
    slope += change / sigma_steps_;
    if (enters) area += change;
    ++(enters ? entering : leaving);
    ++samples_;
  }
  return crossings_;
}

double FieldSampler::horizontal_crossing(const Vec3& g, int axis, double length) {
  const auto cover_along = [&](double at) { return axis == 0 ? cover_x(at) : cover_y(at); };
  const ColumnCover across = axis == 0 ? cover_y(g.y) : cover_x(g.x);
  const ColumnCover first = cover_along(g[axis]), last = cover_along(g[axis] + length);
  const ColumnCover along{first.low, last.high, first.begin, last.end};
  axis == 0 ? need(along, across) : need(across, along);

  // Volume of the materials over each row of columns across the way.
  const double low = g.z - sigma_steps_, high = g.z + sigma_steps_;
  slices_.clear();
  for (int a = along.begin; a < along.end; ++a) {
    double slice = 0;
    for (int b = across.begin; b < across.end; ++b)
      slice += across.of(b) * filled(axis == 0 ? loaded_.at(a, b) : loaded_.at(b, a), low, high);
    slices_.push_back(slice);
  }
  const double whole = across.length() * 2 * sigma_columns_ * (high - low);
  const auto value_at = [&](double share) {
    ++samples_;
    const ColumnCover cover = cover_along(g[axis] + share * length);
    double volume = 0;
    for (int a = cover.begin; a < cover.end; ++a)
      volume += cover.of(a) * slices_[static_cast<std::size_t>(a - along.begin)];
    return 2 * volume / whole - 1 - kInsideAbove;
  };

  // f is linear between the places where a face of the cube passes from column to column.
  constexpr double kTiny = 1e-9;
  const auto next_border = [&](double x) { return std::floor(x + kTiny) + 1; };
  const double f_begin = value_at(0);
  double share = 0, f = f_begin;
  while (share < 1) {
    const double at = g[axis] + share * length;
    const double border = std::min(next_border(at - sigma_columns_) + sigma_columns_,
                                   next_border(at + sigma_columns_) - sigma_columns_);
    const double next = std::min(1.0, (border - g[axis]) / length);
    const double f_next = value_at(next);
    if ((f > 0) != (f_next > 0)) return share + (next - share) * (f / (f - f_next));
    share = next;
    f = f_next;
  }
  return std::abs(f_begin) < std::abs(f) ? 0 : 1;
}

}  // namespace talus
