#include "talus/tools/fill_run.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace talus {

void fill_run(ColumnEditor& column, Steps bottom, Steps top, Material material,
              const MaterialSet& replaces) {
  if (replaces == kAllMaterials) {
    column.replace(bottom, top, material);
    return;
  }
  std::vector<std::pair<Steps, Steps>> parts;
  const auto consider = [&](Material there, Steps from, Steps to) {
    from = std::max(from, bottom);
    to = std::min(to, top);
    if (from < to && replaces.contains(there)) parts.emplace_back(from, to);
  };
  Steps from = column.floor();
  for (const Layer& layer : column.layers()) {
    consider(layer.material(), from, layer.top());
    from = layer.top();
  }
  consider(Material::air, from, top);
  for (const auto& [low, high] : parts) column.replace(low, high, material);
}

}  // namespace talus
