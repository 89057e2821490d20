#include "talus/scatter/thin_plots.h"

#include <utility>

#include "talus/base/hash.h"

namespace talus {

void thin_plots(Plots& plots, const std::function<double(const Plot&)>& density) {
  Plots kept;
  for (Plot plot : plots.plots) {
    if (uniform(hash(plot.key, Purpose::scatter_density)) >= density(plot)) continue;
    const auto corners = plots.corners_of(plot);
    plot.first_corner = static_cast<std::uint32_t>(kept.corners.size());
    kept.plots.push_back(plot);
    kept.corners.insert(kept.corners.end(), corners.begin(), corners.end());
  }
  plots = std::move(kept);
}

}  // namespace talus
