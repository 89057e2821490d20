#include "talus/tools/cover.h"

#include <algorithm>
#include <cmath>

#include "talus/base/angle.h"
#include "talus/field/gradient_noise.h"

namespace talus {
namespace {

// The cover thins out over this last share of the steepest slope.
constexpr double kThinningShare = 0.35;
constexpr double kPatchEdge = 0.25;  // width of a patch's rim in units of its noise

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

bool carries(Material material) {
  const MaterialKind kind = material_info(material).kind;
  return kind == MaterialKind::solid || kind == MaterialKind::granular;
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

// Height of the upward surface of a column that is nearest to `height`.
Steps nearest_floor(std::span<const Layer> layers, Steps terrain_floor, Steps height) {
  Steps nearest = layers.empty() ? terrain_floor : layers.back().top();
  Steps bottom = terrain_floor;
  for (const Layer& layer : layers) {
    if (layer.material() == Material::air && std::abs(bottom - height) < std::abs(nearest - height))
      nearest = bottom;
    bottom = layer.top();
  }
  return nearest;
}

}  // namespace

Booking cover(LayeredTerrain& terrain, const CoverParams& params, std::uint64_t seed, Job* job) {
  validate(params);
  const LayeredTerrain before = terrain;
  const TerrainGrid& grid = terrain.grid();
  const double slope_max_deg =
      params.slope_max_deg.value_or(material_info(params.material).repose_angle_deg);
  const double grade_max = tan_deg(slope_max_deg);
  const GradientNoise noise(seed);
  // Noise above the threshold is covered; as its values crowd about zero, so does the threshold.
  const double threshold = 0.5 - params.coverage * (1 + kPatchEdge);

  const auto grade_at = [&](int x, int y, Steps height) {
    const auto neighbor = [&](int dx, int dy) {
      return static_cast<double>(nearest_floor(
          before.column(std::clamp(x + dx, 0, grid.nx - 1), std::clamp(y + dy, 0, grid.ny - 1)),
          grid.floor, height));
    };
    const double east = neighbor(1, 0) - neighbor(-1, 0), north = neighbor(0, 1) - neighbor(0, -1);
    return std::sqrt(east * east + north * north) * grid.step / (2 * grid.cell);
  };

  return terrain.edit(
      [&](int x, int y, ColumnEditor& column) {
        std::vector<Floor> floors;
        find_floors(before.column(x, y), grid.floor, floors);
        const Vec2 place(grid.origin_x + (x + 0.5) * grid.cell,
                         grid.origin_y + (y + 0.5) * grid.cell);
        double patch = 1;
        if (params.coverage < 1)
          patch = smoothstep(threshold, threshold + kPatchEdge,
                             fractal(noise, place / params.patch_size, {.octaves = 4}));
        for (const Floor& floor : floors) {
          const double height = terrain.height_of(floor.height);
          if (height < params.from_height || height > params.to_height) continue;
          if (floor.roofed && !params.under_roofs) continue;
          const double thinned = 1 - smoothstep((1 - kThinningShare) * grade_max, grade_max,
                                                grade_at(x, y, floor.height));
          const Steps thickness = terrain.nearest_step(params.thickness * patch * thinned);
          column.replace(floor.height, floor.height + std::min(thickness, floor.air),
                         params.material);
        }
      },
      job);
}

}  // namespace talus
