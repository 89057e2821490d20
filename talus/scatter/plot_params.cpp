#include "talus/scatter/plot_params.h"

#include "talus/base/error.h"

namespace talus {

std::vector<double> class_radii(const PlotParams& params) {
  std::vector<double> radii;
  for (const SizeClass& size : params.classes) radii.push_back(size.radius);
  if (params.gaps)
    while (0.5 * radii.back() >= params.gaps->radius_min) radii.push_back(0.5 * radii.back());
  return radii;
}

void validate_plots(const PlotParams& params, const std::string& path) {
  validate(params, path);
  if (params.classes.empty())
    throw usage_error(fmt::format("{}.classes is empty; give one size at least", path));
  double sum = 0;
  for (std::size_t k = 0; k < params.classes.size(); ++k) {
    const SizeClass& size = params.classes[k];
    const std::string name = fmt::format("{}.classes[{}]", path, k);
    validate(size, name);
    if (!size.count) sum += size.area_share;
    if (k > 0 && size.radius > params.classes[k - 1].radius)
      throw usage_error(fmt::format(
          "{}.radius = {} m is larger than {} m before it; give sizes from the largest to the "
          "smallest",
          name, size.radius, params.classes[k - 1].radius));
  }
  if (sum > 1 + 1e-9)
    throw usage_error(fmt::format(
        "{}.classes: area shares are {} in sum; stones cannot cover more than 1", path, sum));
  if (!params.gaps) return;
  validate(*params.gaps, path + ".gaps");
  if (const double largest = 0.5 * params.classes.back().radius; params.gaps->radius_min > largest)
    throw usage_error(fmt::format(
        "{}.gaps.radius_min = {} m is more than {} m, half the radius of the smallest class", path,
        params.gaps->radius_min, largest));
}

}  // namespace talus
