#include "talus/scene/tile_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "talus/scene/tile_fields.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}};
}

Json json_of(const StoneStatistics& stones) {
  return {{"volume_cells", json_of(stones.volume)},
          {"equivalent_diameter_cells", json_of(stones.equivalent_diameter)},
          {"elongation", json_of(stones.elongation)},
          {"flatness", json_of(stones.flatness)},
          {"sphericity", json_of(stones.sphericity)},
          {"equant", stones.equant},
          {"discs", stones.discs},
          {"rods", stones.rods},
          {"blades", stones.blades},
          {"contacts_histogram", stones.contacts}};
}

}  // namespace

TileReport report_tiles(std::span<const std::shared_ptr<const TileSet>> sets) {
  const TileSet& first = *sets.front();
  TileReport report{.variety = std::string(enum_name(first.params().variety)),
                    .seed = first.seed(),
                    .n = first.params().n,
                    .voxels_per_edge = first.params().voxels(),
                    .seed_spacing_cells = first.stats().seed_spacing,
                    .contacts_min = first.stats().contacts_min,
                    .stones = stone_statistics(sets)};
  double total = 0;
  for (const auto& set : sets) total += static_cast<double>(set->stones().size());
  for (const auto& set : sets) {
    const TileStats& stats = set->stats();
    const double share = static_cast<double>(set->stones().size()) / std::max(total, 1.0);
    report.unique += set->stones().size();
    report.distinct_meshes += stats.distinct_meshes;
    report.empty += stats.empty;
    for (const Stone& stone : set->stones()) report.voxels += stone.voxel_count;
    report.fragments_removed += stats.fragments_removed;
    report.seed_spacing_cells = std::min(report.seed_spacing_cells, stats.seed_spacing);
    report.deviation_bound_percent =
        std::max(report.deviation_bound_percent, 100 * stats.deviation_bound);
    report.void_fraction += share * stats.void_fraction;
    report.contacts_mean += share * stats.contacts_mean;
    report.contacts_min = std::min(report.contacts_min, stats.contacts_min);
    report.contacts_lost_fraction += share * stats.contacts_lost_fraction;
    report.below_three_fraction += share * stats.below_three_fraction;
  }
  return report;
}

std::string to_json(const TileReport& report) {
  const Json json = {{"variety", report.variety},
                     {"seed", report.seed},
                     {"n", report.n},
                     {"voxels_per_edge", report.voxels_per_edge},
                     {"unique", report.unique},
                     {"distinct_meshes", report.distinct_meshes},
                     {"empty", report.empty},
                     {"voxels", report.voxels},
                     {"fragments_removed", report.fragments_removed},
                     {"seed_spacing_cells", report.seed_spacing_cells},
                     {"void_fraction", report.void_fraction},
                     {"contacts_mean", report.contacts_mean},
                     {"contacts_min", report.contacts_min},
                     {"contacts_lost_fraction", report.contacts_lost_fraction},
                     {"below_three_fraction", report.below_three_fraction},
                     {"deviation_bound_percent", report.deviation_bound_percent},
                     {"stones", json_of(report.stones)}};
  return json.dump();
}

}  // namespace talus
