#include "talus/terrain/visible_shares.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace talus {
namespace {

MaterialShares rounded_shares(const VisibleShares::Areas& areas, double total) {
  constexpr int kWhole = 255;
  MaterialShares shares{};
  std::array<double, kMaterialCount> remainder{};
  int left = kWhole;
  for (std::size_t m = 0; m < areas.size(); ++m) {
    const double exact = kWhole * (areas[m] / total);
    shares[m] = static_cast<std::uint8_t>(exact);
    remainder[m] = exact - shares[m];
    left -= shares[m];
  }
  for (; left > 0; --left) {
    const auto largest = std::max_element(remainder.begin(), remainder.end());
    ++shares[static_cast<std::size_t>(largest - remainder.begin())];
    *largest = -1;
  }
  return shares;
}

}  // namespace

void VisibleShares::clip(std::span<const Layer> column, double low, double high, Runs& runs) const {
  runs.clear();
  const auto add = [&](double top, Material material) {
    if (top <= low) return true;
    runs.push_back({std::min(top, high), material, materials_.contains(material)});
    return top < high;
  };
  if (!add(grid().floor, Material::bedrock)) return;
  for (const Layer& layer : column)
    if (!add(layer.top(), layer.material())) return;
  add(high, Material::air);
}

// Tops and undersides in one column.
void VisibleShares::add_levels(const Runs& runs, double area) {
  for (std::size_t i = 1; i < runs.size(); ++i)
    if (runs[i - 1].inside != runs[i].inside)
      areas_[index(runs[runs[i].inside ? i : i - 1].material)] += area;
}

// The faces between two columns.
void VisibleShares::add_sides(const Runs& a, const Runs& b, double bottom, double width) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double top = std::min(a[i].top, b[j].top);
    if (a[i].inside != b[j].inside)
      areas_[index(a[i].inside ? a[i].material : b[j].material)] += width * (top - bottom);
    bottom = top;
    if (a[i].top == top) {
      i += 1;
      j += b[j].top == top;
    } else {
      j += 1;
    }
  }
}

const VisibleShares::Areas& VisibleShares::areas(const Vec3& g) {
  const ColumnCover xs = sampler_->cover_x(g.x), ys = sampler_->cover_y(g.y);
  sampler_->need(g.x, g.y);
  const double low = g.z - sampler_->sigma_steps(), high = g.z + sampler_->sigma_steps();
  const double level_area = grid().cell * grid().cell, side_area = grid().cell * grid().step;
  areas_.fill(0);
  below_.resize(static_cast<std::size_t>(xs.end - xs.begin));
  for (int y = ys.begin; y < ys.end; ++y)
    for (int x = xs.begin; x < xs.end; ++x) {
      Runs& below = below_[static_cast<std::size_t>(x - xs.begin)];
      clip(sampler_->layers(x, y), low, high, here_);
      add_levels(here_, level_area * xs.of(x) * ys.of(y));
      if (x > xs.begin) add_sides(left_, here_, low, side_area * ys.of(y));
      if (y > ys.begin) add_sides(below, here_, low, side_area * xs.of(x));
      left_.assign(here_.begin(), here_.end());
      below.swap(here_);
    }
  return areas_;
}

// Bits of those of the materials that reach into the cube.
std::uint32_t VisibleShares::materials_within(const Vec3& g) {
  const ColumnCover xs = sampler_->cover_x(g.x), ys = sampler_->cover_y(g.y);
  const double low = g.z - sampler_->sigma_steps(), high = g.z + sampler_->sigma_steps();
  sampler_->need(g.x, g.y);
  std::uint32_t bits = 0;
  for (int y = ys.begin; y < ys.end; ++y)
    for (int x = xs.begin; x < xs.end; ++x) {
      double bottom = grid().floor;
      if (bottom > low) bits |= 1u << index(Material::bedrock);
      for (const Layer& layer : sampler_->layers(x, y)) {
        if (bottom >= high) break;
        if (layer.top() > low) bits |= 1u << index(layer.material());
        bottom = layer.top();
      }
      if (bottom < high) bits |= 1u << index(Material::air);
    }
  return bits & materials_.bits();
}

Material VisibleShares::nearest(const Vec3& g) const {
  Material best = Material::bedrock;
  double best_distance = std::numeric_limits<double>::infinity();
  const auto consider = [&](double bottom, double top, Material material) {
    const double distance = std::max({0.0, bottom - g.z, g.z - top});
    if (!materials_.contains(material) || distance >= best_distance) return;
    best_distance = distance;
    best = material;
  };
  const ColumnCover xs = sampler_->cover_x(g.x), ys = sampler_->cover_y(g.y);
  double bottom = grid().floor;
  consider(-std::numeric_limits<double>::infinity(), bottom, Material::bedrock);
  for (const Layer& layer : sampler_->layers((xs.begin + xs.end) / 2, (ys.begin + ys.end) / 2)) {
    consider(bottom, layer.top(), layer.material());
    bottom = layer.top();
  }
  return best;
}

MaterialShares VisibleShares::at(const Vec3& g) {
  const std::uint32_t within = materials_within(g);
  if (!std::has_single_bit(within)) {
    areas(g);
    const double total = std::accumulate(areas_.begin(), areas_.end(), 0.0);
    if (total > 0) return rounded_shares(areas_, total);
  }
  MaterialShares shares{};
  shares[std::has_single_bit(within) ? static_cast<std::size_t>(std::countr_zero(within))
                                     : index(nearest(g))] = 255;
  return shares;
}

}  // namespace talus
