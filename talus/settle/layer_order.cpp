#include "talus/settle/layer_order.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// What lies directly on `below` falls into it.
struct FallRule {
  Material below;
  Material material;
  Material becomes;
};
constexpr FallRule kFallRules[] = {{Material::water, Material::snow, Material::water}};

// Deposits between two layers of bedrock, or between bedrock and sky: thickness by material.
struct Deposits {
  std::array<Steps, kMaterialCount> steps{};

  Steps& of(Material m) { return steps[index(m)]; }
  bool adjoin(Material lower, Material upper) const {
    return steps[index(lower)] > 0 && steps[index(upper)] > 0 &&
           std::all_of(steps.begin() + static_cast<std::ptrdiff_t>(index(lower)) + 1,
                       steps.begin() + static_cast<std::ptrdiff_t>(index(upper)),
                       [](Steps s) { return s == 0; });
  }
};

// Sorts one column after another, handing on what less than a step is left of each rule's matter.
class ColumnSorter {
 public:
  void sort(ColumnEditor& column) {
    if (is_sorted(column.layers())) return;
    sorted_.clear();
    conversions_.clear();
    Deposits deposits;
    Steps bottom = column.floor();
    for (const Layer& layer : column.layers()) {
      if (layer.material() == Material::bedrock) {
        settle(deposits, column.floor());
        stack(sorted_, column.floor(), Material::bedrock, layer.top());
        deposits = {};
      } else {
        deposits.of(layer.material()) += layer.top() - bottom;
      }
      bottom = layer.top();
    }
    settle(deposits, column.floor());
    if (!sorted_.empty() && sorted_.back().material() == Material::air) sorted_.pop_back();
    column.rearrange(sorted_, conversions_);
  }

 private:
  static bool is_sorted(std::span<const Layer> layers) {
    for (std::size_t i = 1; i < layers.size(); ++i) {
      const Material below = layers[i - 1].material(), m = layers[i].material();
      if (m == Material::bedrock) continue;
      if (m < below) return false;
      for (const FallRule& rule : kFallRules)
        if (below == rule.below && m == rule.material) return false;
    }
    return true;
  }

  // Lays deposits on what is sorted so far.
  void settle(Deposits& deposits, Steps floor) {
    for (std::size_t r = 0; r < std::size(kFallRules); ++r)
      if (deposits.adjoin(kFallRules[r].below, kFallRules[r].material)) fall(r, deposits);
    Steps z = sorted_.empty() ? floor : sorted_.back().top();
    for (int m = 0; m < kMaterialCount; ++m) {
      z += deposits.of(static_cast<Material>(m));
      stack(sorted_, floor, static_cast<Material>(m), z);
    }
  }

  void fall(std::size_t r, Deposits& deposits) {
    const FallRule& rule = kFallRules[r];
    const std::int64_t density = std::lround(material_info(rule.material).density);
    const std::int64_t new_density = std::lround(material_info(rule.becomes).density);
    TALUS_ASSERT(density <= new_density);  // so that it finds room

    const Steps gone = deposits.of(rule.material);
    const std::int64_t mass = gone * density + carried_[r];
    const auto come = static_cast<Steps>(mass / new_density);
    carried_[r] = mass % new_density;
    conversions_.push_back({rule.material, rule.becomes, gone, come});
    deposits.of(rule.material) = 0;
    deposits.of(rule.becomes) += come;
    deposits.of(Material::air) += gone - come;
  }

  std::array<std::int64_t, std::size(kFallRules)> carried_{};  // kg / m^3 times steps
  std::vector<Layer> sorted_;
  std::vector<Conversion> conversions_;
};

}  // namespace

Booking sort_layers(LayeredTerrain& terrain, const ColumnArea& area, Job* job) {
  const auto tiles_along = [](int columns) {
    return static_cast<std::size_t>((columns - 1) / LayeredTerrain::kTileColumns + 1);
  };
  // The columns of a tile are edited one after the other.
  const std::size_t tiles_x = tiles_along(terrain.grid().nx);
  std::vector<ColumnSorter> sorters(tiles_x * tiles_along(terrain.grid().ny));
  return terrain.edit(
      area,
      [&](int x, int y, ColumnEditor& column) {
        const auto tile_x = static_cast<std::size_t>(x / LayeredTerrain::kTileColumns);
        const auto tile_y = static_cast<std::size_t>(y / LayeredTerrain::kTileColumns);
        sorters[tile_y * tiles_x + tile_x].sort(column);
      },
      job);
}

Booking sort_layers(LayeredTerrain& terrain, Job* job) {
  return sort_layers(terrain, {0, 0, terrain.grid().nx, terrain.grid().ny}, job);
}

}  // namespace talus
