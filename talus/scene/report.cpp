#include "talus/scene/report.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "talus/base/hash.h"
#include "talus/base/parallel.h"
#include "talus/io/digest.h"
#include "talus/io/read_file.h"
#include "talus/mesh/check.h"
#include "talus/scene/pile_check.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

std::optional<TileReport> report_tiles(std::span<const std::shared_ptr<const TileSet>> sets) {
  if (sets.empty()) return std::nullopt;
  const TileParams& first = sets.front()->params();
  TileReport report{.variety = "aperiodic", .n = first.n, .voxels_per_edge = first.voxels()};
  report.contacts_min = sets.front()->stats().contacts_min;

  double total = 0;
  for (const auto& set : sets) total += static_cast<double>(set->stones().size());
  for (const auto& set : sets) {
    const TileStats& stats = set->stats();
    const double share = static_cast<double>(set->stones().size()) / std::max(total, 1.0);
    report.unique += set->stones().size();
    report.distinct_meshes += stats.distinct_meshes;
    report.empty += stats.empty;
    report.void_fraction += share * stats.void_fraction;
    report.contacts_mean += share * stats.contacts_mean;
    report.contacts_min = std::min(report.contacts_min, stats.contacts_min);
    report.contacts_lost_fraction += share * stats.contacts_lost_fraction;
    report.below_three_fraction += share * stats.below_three_fraction;
  }
  return report;
}

StoneReport report_stones(const BuildResult& result) {
  StoneReport report;
  std::uint64_t bytes = 0;
  for (const NamedPile& named : result.piles) {
    report.instances += named.pile.stats.instances;
    report.unique += named.pile.stats.unique;
    report.floating += check_pile(named.pile).floating;
    bytes += named.pile.stones.size() * sizeof(PlacedStone);
  }
  report.bytes_per_stone = static_cast<double>(bytes) /
                           static_cast<double>(std::max<std::uint64_t>(1, report.instances));
  return report;
}

// Sums over the prototypes, and how many of them are not sound.
std::pair<MeshReport, std::uint64_t> report_prototypes(const InstanceTable& table) {
  std::vector<MeshCheck> checks(table.prototypes.size());
  parallel_for(checks.size(), [&](std::size_t i) { checks[i] = check_mesh(*table.prototypes[i]); });
  MeshReport report;
  std::uint64_t unsound = 0;
  for (const MeshCheck& check : checks) {
    report.triangles += check.triangles;
    report.vertices += check.vertices;
    report.closed = report.closed && check.closed();
    report.manifold = report.manifold && check.manifold();
    report.oriented = report.oriented && check.oriented();
    unsound += !(check.closed() && check.manifold() && check.oriented());
  }
  return {report, unsound};
}

std::string hash_of(const BuildResult& result) {
  Digest digest;
  for (const auto& tiles : result.tile_sets) add_to(digest, *tiles);
  add_to(digest, result.stones);
  return digest.hex();
}

Json json_of(const Stage& stage) {
  return {{"name", stage.name},
          {"wall_s", stage.wall_s},
          {"cpu_s", stage.cpu_s},
          {"peak_mb", stage.peak_mb},
          {"cached", stage.cached}};
}

Json json_of(const TileReport& tiles) {
  return {{"variety", tiles.variety},
          {"n", tiles.n},
          {"voxels_per_edge", tiles.voxels_per_edge},
          {"unique", tiles.unique},
          {"distinct_meshes", tiles.distinct_meshes},
          {"empty", tiles.empty},
          {"void_fraction", tiles.void_fraction},
          {"contacts_mean", tiles.contacts_mean},
          {"contacts_min", tiles.contacts_min},
          {"contacts_lost_fraction", tiles.contacts_lost_fraction},
          {"below_three_fraction", tiles.below_three_fraction}};
}

Json json_of(const StoneReport& stones) {
  return {{"instances", stones.instances},
          {"unique", stones.unique},
          {"floating", stones.floating},
          {"bytes_per_stone", stones.bytes_per_stone}};
}

Json json_of(const MeshReport& mesh) {
  return {{"triangles", mesh.triangles},
          {"vertices", mesh.vertices},
          {"closed", mesh.closed},
          {"manifold", mesh.manifold},
          {"oriented", mesh.oriented}};
}

Json json_of(const Check& check) {
  return {{"name", check.name}, {"ok", check.ok}, {"detail", check.detail}};
}

}  // namespace

Report make_report(const BuildResult& result, const std::filesystem::path& folder) {
  Report report{.talus = std::string(version()),
                .recipe = to_toml(result.recipe, folder),
                .seed = result.recipe.seed,
                .threads = thread_count(),
                .hash = hash_of(result),
                .stages = result.stages,
                .tiles = report_tiles(result.tile_sets),
                .stones = report_stones(result)};

  const auto [stones, unsound] = report_prototypes(result.stones);
  report.meshes.emplace_back("stones", stones);
  const std::size_t meshes = result.stones.prototypes.size();
  report.checks.push_back(
      {.name = "meshes_closed",
       .ok = unsound == 0,
       .detail = unsound == 0
                     ? fmt::format("all {} meshes are closed, manifold and oriented", meshes)
                     : fmt::format("{} of {} meshes are open, non-manifold or misoriented", unsound,
                                   meshes)});
  const std::uint64_t floating = report.stones->floating;
  report.checks.push_back(
      {.name = "stones_held",
       .ok = floating == 0,
       .detail = floating == 0
                     ? "every stone is held by contacts that reach the ground"
                     : fmt::format("{} of {} stones touch others, but none that reaches the ground",
                                   floating, report.stones->instances)});
  return report;
}

Report make_report(const MadeTiles& made) {
  Digest digest;
  add_to(digest, *made.tiles);
  return {.talus = std::string(version()),
          .seed = made.tiles->seed(),
          .threads = thread_count(),
          .hash = digest.hex(),
          .stages = {made.stage},
          .tiles = report_tiles(std::span(&made.tiles, 1))};
}

std::string to_json(const Report& report) {
  Json json = {{"talus", report.talus}};
  if (!report.recipe.empty()) json["recipe"] = report.recipe;
  json["seed"] = report.seed;
  json["threads"] = report.threads;
  json["hash"] = report.hash;
  json["stages"] = Json::array();
  for (const Stage& stage : report.stages) json["stages"].push_back(json_of(stage));
  if (report.tiles) json["tiles"] = json_of(*report.tiles);
  if (report.stones) json["stones"] = json_of(*report.stones);
  for (const auto& [name, mesh] : report.meshes) json["meshes"][name] = json_of(mesh);
  if (!report.checks.empty()) json["checks"] = Json::array();
  for (const Check& check : report.checks) json["checks"].push_back(json_of(check));
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Recipe load_reported_recipe(const std::filesystem::path& file) {
  const Json json = Json::parse(read_file(file), nullptr, false);
  const auto recipe = json.is_object() ? json.find("recipe") : json.end();
  if (recipe == json.end() || !recipe->is_string())
    throw input_error(file.string() + ": no report of a scene");
  return read_recipe(parse_document(recipe->get<std::string>(), file.string()), file.parent_path());
}

}  // namespace talus
