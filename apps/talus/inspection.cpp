#include "apps/talus/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "talus/base/error.h"
#include "talus/io/inspect.h"
#include "talus/io/read_file.h"

namespace talus::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const MeshCheck& check) {
  return {{"triangles", check.triangles},
          {"vertices", check.vertices},
          {"closed", check.closed()},
          {"manifold", check.manifold()},
          {"oriented", check.oriented()},
          {"boundary_edges", check.boundary_edges},
          {"non_manifold_edges", check.non_manifold_edges},
          {"degenerate", check.degenerate}};
}

Json json_of(const MeshInfo& mesh) {
  Json json = json_of(mesh.check);
  json["bounds"] = {json_of(mesh.bounds.min), json_of(mesh.bounds.max)};
  json["volume_m3"] = mesh.volume ? Json(*mesh.volume) : Json(nullptr);
  return json;
}

// `triangles` are those drawn; the rest is of the distinct meshes.
Json json_of(const ScenePart& part) {
  Json json = {{"instances", part.instances}, {"unique", part.unique}};
  json.update(json_of(part.check));
  json["triangles"] = part.triangles;
  return json;
}

Json json_of(const InstancingCheck& instancing) {
  return {{"instances", instancing.instances},
          {"prototypes", instancing.prototypes},
          {"sound", instancing.problems.empty()},
          {"problems", instancing.problems}};
}

Json json_of(const Inspection& found, const fs::path& file) {
  Json json = {{"file", file.string()}, {"bytes", found.bytes}};
  if (found.mesh) json["mesh"] = json_of(*found.mesh);
  for (const ScenePart& part : found.parts) json["parts"][part.name] = json_of(part);
  if (found.instancing) json["instancing"] = json_of(*found.instancing);
  if (found.tiles) json["tiles"] = Json::parse(to_json(report_tiles({&found.tiles, 1})));
  json["warnings"] = found.warnings;
  return json;
}

// The terrain in the report beside a folder's scene; null if there is none.
Json reported_terrain(const fs::path& subject) {
  std::error_code error;
  const fs::path file = subject / "report.json";
  if (!fs::is_directory(subject, error) || !fs::exists(file, error)) return nullptr;
  const Json report = Json::parse(read_file(file), nullptr, false);
  if (!report.is_object() || !report.contains("terrain")) return nullptr;
  return {{"terrain", report["terrain"]}, {"ledger", report.value("ledger", Json::array())}};
}

std::string terrain_text(const Json& reported) {
  const Json& terrain = reported["terrain"];
  const double cell = terrain.at("cell_m"), step = terrain.at("step_m");
  std::string text = fmt::format(
      "terrain: {} columns of {} m, {} layers, {:.1f} MB ({:.1f} bytes a column)\n",
      terrain.at("columns").get<std::uint64_t>(), cell, terrain.at("layers").get<std::uint64_t>(),
      terrain.at("bytes").get<double>() / 1e6, terrain.at("bytes_per_column").get<double>());
  for (const auto& [material, steps] : terrain.at("volume_steps").items())
    text += fmt::format("  {} in the columns: {:.6g} m^3\n", material,
                        steps.get<double>() * step * cell * cell);
  // Reports of earlier versions lack these.
  if (terrain.contains("mesh_deviation_p99_m"))
    text += fmt::format(
        "  the ground mesh leaves the tops of the ground by {:.3g} m on average, at most {:.3g} m\n"
        "  for 99 % and {:.3g} m for all columns\n",
        terrain.at("mesh_deviation_mean_m").get<double>(),
        terrain.at("mesh_deviation_p99_m").get<double>(),
        terrain.at("mesh_deviation_max_m").get<double>());
  if (const auto lost = terrain.value("mesh_columns_lost", std::uint64_t{0}); lost > 0)
    text += fmt::format("  besides, {} columns end in what is too thin for the mesh\n", lost);
  const Json& ledger = reported["ledger"];
  const auto balanced = std::count_if(ledger.begin(), ledger.end(),
                                      [](const Json& entry) { return entry.at("balanced"); });
  return text + fmt::format("  {} of {} operations balance\n", balanced, ledger.size());
}

// The file that stands for a folder of results.
fs::path file_of(const fs::path& subject) {
  // What cannot be looked at is refused when it is read.
  std::error_code error;
  if (!fs::is_directory(subject, error)) {
    if (subject.extension() == ".toml" && fs::exists(subject, error))
      throw input_error(fmt::format(
          "{}: a recipe is not inspected, but what is built of it: `talus build {} -o DIR`, then "
          "`talus inspect DIR`",
          subject.string(), subject.string()));
    return subject;
  }
  for (const char* name : {"scene.glb", "scene.ply", "scene.obj"})
    if (fs::exists(subject / name, error)) return subject / name;
  throw input_error(subject.string() +
                    ": no scene.glb, scene.ply or scene.obj in this folder; name a file");
}

// What a mesh is: closed, merely open, or not sound. Border edges are the only ones of a surface
// along which triangles do not run both ways.
std::string verdict(const MeshCheck& check) {
  const bool balanced = check.unbalanced_edges == check.boundary_edges && check.degenerate == 0;
  const std::string touching = fmt::format("pieces that touch along {} edges and in {} vertices",
                                           check.non_manifold_edges, check.non_manifold_vertices);
  if (balanced && check.bounds_solids())
    return fmt::format("sound: closed, {}", check.manifold() ? "manifold, oriented" : touching);
  if (balanced && check.boundary_edges > 0)
    return fmt::format("open: {} border edges, {}", check.boundary_edges,
                       check.manifold() ? "manifold, oriented" : touching);
  std::string flaws;
  const auto flaw = [&](std::uint64_t count, std::string_view what) {
    if (count > 0) flaws += fmt::format("{}{} {}", flaws.empty() ? "" : ", ", count, what);
  };
  flaw(check.boundary_edges, "border edges");
  flaw(check.non_manifold_edges, "edges with more than two triangles");
  flaw(check.non_manifold_vertices, "pinched vertices");
  flaw(check.misoriented_edges, "edges between triangles that face apart");
  flaw(check.degenerate, "triangles without area");
  return "not sound: " + flaws;
}

// Parts are judged by themselves: together they may touch and overlap.
std::string mesh_text(const MeshInfo& mesh, bool has_parts) {
  const Vec3 size = mesh.bounds.size();
  std::string text = fmt::format(
      "{} triangles, {} vertices\n"
      "{:.6g} x {:.6g} x {:.6g} m, from ({:.6g}, {:.6g}, {:.6g})",
      mesh.check.triangles, mesh.check.vertices, size.x, size.y, size.z, mesh.bounds.min.x,
      mesh.bounds.min.y, mesh.bounds.min.z);
  if (mesh.volume) text += fmt::format(", the mesh encloses {:.6g} m^3", *mesh.volume);
  text += "\n";
  if (!has_parts || mesh.volume) text += verdict(mesh.check) + "\n";
  return text;
}

}  // namespace

std::string tiles_text(const TileReport& tiles) {
  constexpr double kNegligible = 1;  // percent
  const StoneStatistics& stones = tiles.stones;
  std::string text = fmt::format(
      "{} tile set of seed {}: n = {}, {} voxels along an edge\n"
      "{} stones of {} meshes, {} empty\n"
      "{:.2g} cells across on average, {:.2g} to {:.2g}; {:.0f} % equant, {:.0f} % discs, "
      "{:.0f} % rods, {:.0f} % blades\n"
      "{:.1f} contacts a stone on average, {} at least; {:.1f} % of space is empty\n",
      tiles.variety, tiles.seed, tiles.n, tiles.voxels_per_edge, tiles.unique,
      tiles.distinct_meshes, tiles.empty, stones.equivalent_diameter.mean,
      stones.equivalent_diameter.min, stones.equivalent_diameter.max, 100 * stones.equant,
      100 * stones.discs, 100 * stones.rods, 100 * stones.blades, tiles.contacts_mean,
      tiles.contacts_min, 100 * tiles.void_fraction);
  if (tiles.deviation_bound_percent > kNegligible)
    text += fmt::format("on {:.2g} % of space a stone too far away to compete could be nearer\n",
                        tiles.deviation_bound_percent);
  return text;
}

std::string inspection_text(const fs::path& subject) {
  const fs::path file = file_of(subject);
  const Inspection found = inspect(file);
  std::string text = fmt::format("{}: {} bytes\n", file.string(), found.bytes);
  if (const Json reported = reported_terrain(subject); !reported.is_null()) {
    try {
      text += terrain_text(reported);
    } catch (const Json::exception&) {
      throw input_error((subject / "report.json").string() + ": no report that Talus wrote");
    }
  }
  for (const ScenePart& part : found.parts)
    text += fmt::format("{}: {} instances of {} meshes, {} triangles drawn\n{}\n", part.name,
                        part.instances, part.unique, part.triangles, verdict(part.check));
  if (found.instancing)
    text += found.instancing->problems.empty() ? "sound: instancing\n" : "not sound: instancing\n";
  if (found.instancing)
    for (const std::string& problem : found.instancing->problems) text += "  " + problem + "\n";
  if (found.mesh) text += mesh_text(*found.mesh, !found.parts.empty());
  if (found.tiles) text += tiles_text(report_tiles({&found.tiles, 1}));
  for (const std::string& warning : found.warnings) text += "note: " + warning + "\n";
  return text;
}

std::string inspection_json(const fs::path& subject) {
  const fs::path file = file_of(subject);
  Json json = json_of(inspect(file), file);
  if (const Json reported = reported_terrain(subject); !reported.is_null()) json.update(reported);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_text(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace talus::cli
