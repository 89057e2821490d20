#include "talus/rocks/stone_statistics.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "talus/base/parallel.h"
#include "talus/mesh/shape_measures.h"
#include "talus/rocks/colors.h"

namespace talus {
namespace {

// Of every mesh once: stones share them.
class MeasuredMeshes {
 public:
  explicit MeasuredMeshes(std::span<const std::shared_ptr<const TileSet>> sets) {
    std::vector<const TriangleMesh*> meshes;
    for (const auto& set : sets)
      for (const Stone& stone : set->stones())
        if (stone.mesh && index_.try_emplace(stone.mesh.get(), meshes.size()).second)
          meshes.push_back(stone.mesh.get());
    measures_.resize(meshes.size());
    parallel_for(
        meshes.size(), [&](std::size_t i) { measures_[i] = measure_shape(*meshes[i]); }, 64);
  }
  const ShapeMeasures& of(const Stone& stone) const {
    return measures_[index_.at(stone.mesh.get())];
  }

 private:
  std::unordered_map<const TriangleMesh*, std::size_t> index_;
  std::vector<ShapeMeasures> measures_;
};

class SpreadSum {
 public:
  void add(double value, double weight) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    sum_ += weight * value;
  }
  Spread over(double weights) const { return {low_, sum_ / weights, high_}; }

 private:
  double low_ = std::numeric_limits<double>::max();
  double high_ = std::numeric_limits<double>::lowest();
  double sum_ = 0;
};

}  // namespace

StoneStatistics stone_statistics(std::span<const std::shared_ptr<const TileSet>> sets) {
  const MeasuredMeshes measured(sets);
  StoneStatistics result;
  SpreadSum volume, diameter, flatness, elongation, sphericity;
  double weights = 0;
  for (const auto& set : sets) {
    const rocks::CellLayout layout(set->params());
    for (const Stone& stone : set->stones()) {
      if (!stone.mesh) continue;
      const double weight = layout.frequency(stone.cell);
      const ShapeMeasures& shape = measured.of(stone);
      const double b_over_a = shape.lengths.y / shape.lengths.x;
      const double c_over_b = shape.lengths.z / shape.lengths.y;
      volume.add(shape.volume, weight);
      diameter.add(shape.equivalent_diameter(), weight);
      flatness.add(c_over_b, weight);
      elongation.add(b_over_a, weight);
      sphericity.add(shape.sphericity(), weight);

      constexpr double kLimit = 2.0 / 3;
      const bool wide = b_over_a > kLimit, thick = c_over_b > kLimit;
      (wide ? thick ? result.equant : result.discs : thick ? result.rods : result.blades) += weight;

      const auto kept = static_cast<std::size_t>(std::count_if(
          stone.contacts.begin(), stone.contacts.end(), [](const auto& c) { return c.kept; }));
      if (kept >= result.contacts.size()) result.contacts.resize(kept + 1, 0);
      result.contacts[kept] += weight;
      weights += weight;
    }
  }
  if (weights == 0) return result;

  result.volume = volume.over(weights);
  result.equivalent_diameter = diameter.over(weights);
  result.flatness = flatness.over(weights);
  result.elongation = elongation.over(weights);
  result.sphericity = sphericity.over(weights);
  for (double* share : {&result.equant, &result.discs, &result.rods, &result.blades})
    *share /= weights;
  for (double& share : result.contacts) share /= weights;
  return result;
}

}  // namespace talus
