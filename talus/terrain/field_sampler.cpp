#include "talus/terrain/field_sampler.h"

#include <glm/geometric.hpp>
#include <limits>

namespace talus {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

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
      loaded_.end_column();
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

Vec3 FieldSampler::gradient(const Vec3& g) {
  need(g.x, g.y);
  return gradient(g, sigma_steps_);
}

// The gradient for a cube stretched along z, in the scale of the true one: df/dz as if z were not
// stretched.
Vec3 FieldSampler::gradient(const Vec3& g, double half_height) {
  const ColumnCover xs = cover_x(g.x), ys = cover_y(g.y);
  const double low = g.z - half_height, high = g.z + half_height;
  ++samples_;

  // How much of the cube's height the materials fill in its columns, and in those behind faces
  // between columns; what reaches through the upper face less what reaches through the lower, half
  // of what ends there.
  const auto first_column = [](const ColumnCover& c) {
    return static_cast<int>(std::ceil(c.low)) - 1;
  };
  const auto last_column = [](const ColumnCover& c) {
    return static_cast<int>(std::floor(c.high));
  };
  const int x_first = first_column(xs), x_last = last_column(xs);
  const int y_first = first_column(ys), y_last = last_column(ys);
  const auto passes = [](double end, double z) { return 0.5 * ((z > end) + (z >= end)); };
  double area = 0;
  fills_.clear();
  for (int y = y_first; y <= y_last; ++y) {
    const bool covers_y = y >= ys.begin && y < ys.end;
    for (int x = x_first; x <= x_last; ++x) {
      const bool covers_x = x >= xs.begin && x < xs.end;
      const std::span<const Interval> column = loaded_.at(x, y);
      fills_.push_back(covers_x || covers_y ? filled(column, low, high) : 0);
      if (!covers_x || !covers_y) continue;
      double difference = 0;
      for (const Interval& i : column)
        difference += passes(i.bottom, high) - passes(i.top, high) - passes(i.bottom, low) +
                      passes(i.top, low);
      area += xs.of(x) * ys.of(y) * difference;
    }
  }

  // Share of the materials in a face: the mean over the columns from `first` to `last`, one or the
  // two on both sides.
  const auto fill = [&](int x, int y) {
    return fills_[static_cast<std::size_t>((y - y_first) * (x_last - x_first + 1) + x - x_first)];
  };
  const auto face_x = [&](int first, int last) {
    double sum = 0;
    for (int x = first; x <= last; ++x)
      for (int y = ys.begin; y < ys.end; ++y) sum += ys.of(y) * fill(x, y);
    return sum / ((last - first + 1) * ys.length() * (high - low));
  };
  const auto face_y = [&](int first, int last) {
    double sum = 0;
    for (int y = first; y <= last; ++y)
      for (int x = xs.begin; x < xs.end; ++x) sum += xs.of(x) * fill(x, y);
    return sum / ((last - first + 1) * xs.length() * (high - low));
  };
  const Vec3 difference(face_x(xs.end - 1, x_last) - face_x(x_first, xs.begin),
                        face_y(ys.end - 1, y_last) - face_y(y_first, ys.begin),
                        area / (xs.length() * ys.length()) * (sigma_steps_ / half_height));
  return difference / field_->sigma();
}

// How far above and below a point no layer nearby ends that faces down, or up if not `upward`.
double FieldSampler::room(const Vec3& g, bool upward) const {
  const ColumnCover xs = cover_x(g.x), ys = cover_y(g.y);
  double room = kEndless;
  for (int y = ys.begin - 1; y < ys.end + 1; ++y)
    for (int x = xs.begin - 1; x < xs.end + 1; ++x)
      for (const Interval& interval : loaded_.at(x, y))
        room = std::min(room, std::abs((upward ? interval.bottom : interval.top) - g.z));
  return room;
}

std::optional<Vec3> FieldSampler::normal(const Vec3& g) {
  Vec3 inward = gradient(g);
  if (std::abs(inward.x) + std::abs(inward.y) > 0.5 * std::abs(inward.z)) {
    const double half_height = std::min(room(g, inward.z <= 0), kStretchMax * sigma_steps_);
    if (half_height > sigma_steps_) inward = gradient(g, half_height);
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
