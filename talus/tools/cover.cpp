#include "talus/tools/cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "talus/base/angle.h"
#include "talus/field/gradient_noise.h"

namespace talus {
namespace {

// The cover thins out over this last share of the steepest slope.
constexpr double kThinningShare = 0.35;

// Patches are where the noise exceeds a level; over this much of the noise a patch's rim rises.
constexpr double kPatchRim = 0.25;
constexpr int kPatchOctaves = 4;

// The share of the plane above each level of that noise, measured on 20 000 places; below zero it
// is the mirror image.
struct LevelShare {
  double level;
  double share;
};
constexpr std::array<LevelShare, 6> kLevelShares = {
    {{0.63, 0}, {0.5, 0.0015}, {0.375, 0.02}, {0.25, 0.09}, {0.125, 0.26}, {0, 0.5}}};

// The level that the noise exceeds on that share of the plane.
double level_of(double share) {
  if (share > 0.5) return -level_of(1 - share);
  std::size_t i = 1;
  while (i + 1 < kLevelShares.size() && kLevelShares[i].share < share) ++i;
  const LevelShare &low = kLevelShares[i - 1], &high = kLevelShares[i];
  return low.level + (high.level - low.level) * (share - low.share) / (high.share - low.share);
}

double smoothstep(double low, double high, double x) {
  if (!(low < high)) return x > high ? 1 : 0;
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Stones fill their layer only in part: a cover lies beside them, and neither on them nor less
// thick for the slope of their heap.
bool is_open(Material material) { return material == Material::air || material == Material::rocks; }

bool carries(Material material) {
  const MaterialKind kind = material_info(material).kind;
  return !is_open(material) && (kind == MaterialKind::solid || kind == MaterialKind::granular);
}

// An upward surface of a column: where ground ends and air begins.
struct Floor {
  Steps height = 0;
  Steps air = 0;  // steps of air above
  bool roofed = false;
};

void find_floors(std::span<const Layer> layers, Steps terrain_floor, std::vector<Floor>& floors) {
  floors.clear();
  Steps bottom = terrain_floor;
  Material below = Material::bedrock;
  for (const Layer& layer : layers) {
    if (layer.material() == Material::air && carries(below))
      floors.push_back({bottom, layer.top() - bottom, true});
    below = layer.material();
    bottom = layer.top();
  }
  if (carries(below)) floors.push_back({bottom, kStepsMax - bottom, false});
}

// Height of the upward surface of a column that is nearest to `height`, the ground under stones
// included.
Steps nearest_floor(std::span<const Layer> layers, Steps terrain_floor, Steps height) {
  std::optional<Steps> nearest;
  const auto consider = [&](Steps surface) {
    if (!nearest || std::abs(surface - height) <= std::abs(*nearest - height)) nearest = surface;
  };
  Steps bottom = terrain_floor;
  Material below = Material::bedrock;
  for (const Layer& layer : layers) {
    if (is_open(layer.material()) && !is_open(below)) consider(bottom);
    below = layer.material();
    bottom = layer.top();
  }
  if (!is_open(below)) consider(bottom);
  return *nearest;
}

}  // namespace

Booking cover(LayeredTerrain& terrain, const CoverParams& params, std::uint64_t seed, Job* job) {
  validate(params);
  if (params.coverage == 0) return {};
  const LayeredTerrain before = terrain;
  const TerrainGrid& grid = terrain.grid();
  const double slope_max_deg =
      params.slope_max_deg.value_or(material_info(params.material).repose_angle_deg);
  const double grade_max = tan_deg(slope_max_deg);
  const GradientNoise noise(seed);
  const double patch_level = level_of(params.coverage);

  const auto grade_at = [&](int x, int y, Steps height) {
    const auto floor_at = [&](int i, int j) {
      return static_cast<double>(nearest_floor(before.column(i, j), grid.floor, height));
    };
    // At the border one side has no neighbor.
    const int west = std::max(x - 1, 0), east = std::min(x + 1, grid.nx - 1);
    const int south = std::max(y - 1, 0), north = std::min(y + 1, grid.ny - 1);
    const double dx = (floor_at(east, y) - floor_at(west, y)) / std::max(1, east - west);
    const double dy = (floor_at(x, north) - floor_at(x, south)) / std::max(1, north - south);
    return std::sqrt(dx * dx + dy * dy) * grid.step / grid.cell;
  };

  return terrain.edit(
      [&](int x, int y, ColumnEditor& column) {
        std::vector<Floor> floors;
        find_floors(before.column(x, y), grid.floor, floors);
        const Vec2 place = grid.center(x, y);
        double patch = 1;
        if (params.coverage < 1)
          patch = smoothstep(patch_level - 0.5 * kPatchRim, patch_level + 0.5 * kPatchRim,
                             fractal(noise, place / params.patch_size, {.octaves = kPatchOctaves}));
        for (const Floor& floor : floors) {
          const double height = terrain.height_of(floor.height);
          if (height < params.from_height || height > params.to_height) continue;
          if (floor.roofed && !params.under_roofs) continue;
          double thinned = 1;  // a limit of 90 degrees is none
          if (std::isfinite(grade_max))
            thinned -= smoothstep((1 - kThinningShare) * grade_max, grade_max,
                                  grade_at(x, y, floor.height));
          const Steps thickness = terrain.nearest_step(params.thickness * patch * thinned);
          column.replace(floor.height, floor.height + std::min(thickness, floor.air),
                         params.material);
        }
      },
      job);
}

}  // namespace talus
