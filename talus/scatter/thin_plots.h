// Fewer plots where the ground bears fewer stones.
#pragma once

#include <functional>

#include "talus/scatter/plots.h"

namespace talus {

// Keeps each plot with the probability that `density` gives, drawn by its key: what is kept where
// the density is lower is kept where it is higher, and plots made region by region are thinned
// alike. Nothing else moves into what becomes free. Densities from a painted mask, the slope or the
// distance to water are alike to it.
void thin_plots(Plots& plots, const std::function<double(const Plot&)>& density);

}  // namespace talus
