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
#include "talus/piles/pile_check.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

TerrainReport report_terrain(const TerrainResult& result) {
  const LayeredTerrain& terrain = result.terrain;
  const TerrainGrid& grid = terrain.grid();
  const auto bytes = static_cast<double>(terrain.bytes());
  return {.columns = terrain.column_count(),
          .layers = terrain.layer_count(),
          .bytes = terrain.bytes(),
          .bytes_per_column = bytes / static_cast<double>(terrain.column_count()),
          .bytes_per_layer =
              bytes / static_cast<double>(std::max<std::size_t>(1, terrain.layer_count())),
          .step_m = grid.step,
          .size_m = {grid.nx * grid.cell, grid.ny * grid.cell},
          .cell_m = grid.cell,
          .crs = result.georeference.crs,
          .offset = {result.georeference.offset.x, result.georeference.offset.y},
          .volume_steps = terrain.volume(),
          .mesh_deviation_max_m = result.ground.deviation_max,
          .mesh_deviation_p99_m = result.ground.deviation_p99,
          .mesh_deviation_mean_m = result.ground.deviation_mean,
          .mesh_columns_lost = result.ground.columns_lost};
}

MeshReport report_mesh(const TriangleMesh& mesh) {
  const MeshCheck check = check_mesh(mesh);
  return {.triangles = check.triangles,
          .vertices = check.vertices,
          .closed = check.closed(),
          .manifold = check.manifold(),
          .oriented = check.oriented()};
}

// Where stones fill layers they lie on the terrain, which is no part of the pile.
bool stands_alone(const NamedPile& named) { return !named.in_terrain; }

StoneReport report_stones(const BuildResult& result) {
  StoneReport report;
  std::uint64_t bytes = 0;
  for (const NamedPile& named : result.piles) {
    report.instances += named.pile.stats.instances;
    report.unique += named.pile.stats.unique;
    if (stands_alone(named)) report.floating += check_pile(named.pile).floating;
    bytes += named.pile.stones.bytes() + named.pile.moved.size() * sizeof(MovedStone);
  }
  report.bytes_per_stone = static_cast<double>(bytes) /
                           static_cast<double>(std::max<std::uint64_t>(1, report.instances));
  return report;
}

PileReport report_pile(const NamedPile& named) {
  const PileStats& stats = named.pile.stats;
  return {.name = named.name,
          .instances = stats.instances,
          .hidden = stats.hidden,
          .isolated = stats.isolated,
          .thinned = stats.thinned,
          .gap_fraction = stats.gap_fraction()};
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
  if (result.terrain) {
    add_to(digest, result.terrain->terrain);
    add_to(digest, result.terrain->ground.mesh);
    add_to(digest, result.terrain->water);
  }
  for (const auto& tiles : result.tile_sets) add_to(digest, *tiles);
  add_to(digest, result.stones);
  return digest.hex();
}

void add_terrain(Report& report, const TerrainResult& result,
                 const std::vector<std::string>& idle) {
  report.terrain = report_terrain(result);
  report.ledger = result.ledger;
  const auto unbalanced = std::count_if(result.ledger.begin(), result.ledger.end(),
                                        [](const LedgerEntry& entry) { return !entry.balanced; });
  report.checks.push_back(
      {.name = "ledger_balanced",
       .ok = unbalanced == 0,
       .detail = unbalanced == 0 ? "every operation moved what it booked, to the step"
                                 : fmt::format("{} operations moved other volumes than they booked",
                                               unbalanced)});

  report.checks.push_back(
      {.name = "operations_effective",
       .ok = idle.empty(),
       .detail = idle.empty() ? "every operation on the terrain changed it"
                              : fmt::format("{}: nothing was changed; what it fills or covers lies "
                                            "outside the terrain, between the middles of its "
                                            "columns, or is so already",
                                            fmt::join(idle, ", "))});

  const MeshReport ground = report_mesh(result.ground.mesh);
  report.meshes.emplace_back("ground", ground);
  report.checks.push_back({.name = "ground_sound",
                           .ok = ground.manifold && ground.oriented,
                           .detail = ground.manifold && ground.oriented
                                         ? "the ground mesh is manifold and oriented"
                                         : "the ground mesh is non-manifold or misoriented"});
  if (!result.water.triangles.empty())
    report.meshes.emplace_back("water", report_mesh(result.water));
}

void add_stones(Report& report, const BuildResult& result) {
  report.stones = report_stones(result);
  for (const NamedPile& named : result.piles) report.piles.push_back(report_pile(named));
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
  if (std::none_of(result.piles.begin(), result.piles.end(), stands_alone)) return;
  const std::uint64_t floating = report.stones->floating;
  report.checks.push_back(
      {.name = "stones_held",
       .ok = floating == 0,
       .detail = floating == 0
                     ? "every stone is held by contacts that reach the ground"
                     : fmt::format("{} of {} stones touch others, but none that reaches the ground",
                                   floating, report.stones->instances)});
}

// The members that are not zero, by the materials' names.
Json json_of(const MaterialSteps& steps) {
  Json json = Json::object();
  for (int m = 0; m < kMaterialCount; ++m)
    if (const std::int64_t n = steps[static_cast<std::size_t>(m)]; n != 0)
      json[std::string(material_info(static_cast<Material>(m)).name)] = n;
  return json;
}

Json json_of(const TerrainReport& terrain) {
  return {{"columns", terrain.columns},
          {"layers", terrain.layers},
          {"bytes", terrain.bytes},
          {"bytes_per_column", terrain.bytes_per_column},
          {"bytes_per_layer", terrain.bytes_per_layer},
          {"step_m", terrain.step_m},
          {"size_m", terrain.size_m},
          {"cell_m", terrain.cell_m},
          {"crs", terrain.crs},
          {"offset", terrain.offset},
          {"volume_steps", json_of(terrain.volume_steps)},
          {"mesh_deviation_max_m", terrain.mesh_deviation_max_m},
          {"mesh_deviation_p99_m", terrain.mesh_deviation_p99_m},
          {"mesh_deviation_mean_m", terrain.mesh_deviation_mean_m},
          {"mesh_columns_lost", terrain.mesh_columns_lost}};
}

Json json_of(const LedgerEntry& entry) {
  MaterialSteps added{}, removed{};
  Json converted = Json::array();
  for (int from = 0; from < kMaterialCount; ++from) {
    const auto a = static_cast<Material>(from);
    added[static_cast<std::size_t>(from)] = entry.booking.added(a);
    removed[static_cast<std::size_t>(from)] = entry.booking.removed(a);
    for (int to = 0; to < kMaterialCount; ++to) {
      const auto b = static_cast<Material>(to);
      const Conversion c = entry.booking.conversion(a, b);
      if (a == Material::air || b == Material::air || c.from_steps == 0) continue;
      converted.push_back({material_info(a).name, material_info(b).name, c.from_steps, c.to_steps});
    }
  }
  return {{"operation", entry.operation},
          {"added", json_of(added)},
          {"removed", json_of(removed)},
          {"converted", converted},
          {"balanced", entry.balanced}};
}

Json json_of(const Stage& stage) {
  Json json = {{"name", stage.name},
               {"wall_s", stage.wall_s},
               {"cpu_s", stage.cpu_s},
               {"peak_mb", stage.peak_mb},
               {"cached", stage.cached}};
  for (const Stage& phase : stage.phases)
    json["phases"].push_back(
        {{"name", phase.name}, {"wall_s", phase.wall_s}, {"cpu_s", phase.cpu_s}});
  return json;
}

Json json_of(const PileReport& pile) {
  return {{"name", pile.name},       {"instances", pile.instances},
          {"hidden", pile.hidden},   {"isolated", pile.isolated},
          {"thinned", pile.thinned}, {"gap_fraction", pile.gap_fraction}};
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
                .stages = result.stages};
  if (!result.tile_sets.empty()) report.tiles = report_tiles(result.tile_sets);
  if (result.terrain) add_terrain(report, *result.terrain, result.idle_operations);
  if (!result.piles.empty()) add_stones(report, result);
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
  if (report.terrain) {
    json["terrain"] = json_of(*report.terrain);
    json["ledger"] = Json::array();
    for (const LedgerEntry& entry : report.ledger) json["ledger"].push_back(json_of(entry));
  }
  if (report.tiles) json["tiles"] = Json::parse(to_json(*report.tiles));
  if (report.stones) json["stones"] = json_of(*report.stones);
  for (const PileReport& pile : report.piles) json["piles"].push_back(json_of(pile));
  for (const auto& [name, mesh] : report.meshes) json["meshes"][name] = json_of(mesh);
  if (!report.checks.empty()) json["checks"] = Json::array();
  for (const Check& check : report.checks) json["checks"].push_back(json_of(check));
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Recipe load_reported_recipe(const std::filesystem::path& file,
                            const std::function<Value(Value)>& change) {
  const Json json = Json::parse(read_file(file), nullptr, false);
  const auto recipe = json.is_object() ? json.find("recipe") : json.end();
  if (recipe == json.end() || !recipe->is_string())
    throw input_error(file.string() + ": no report of a scene");
  const std::string name = file.string() + ": recipe";
  return read_recipe(change(parse_document(recipe->get<std::string>(), name)), file.parent_path());
}

}  // namespace talus
