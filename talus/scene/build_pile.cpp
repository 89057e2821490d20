#include <algorithm>
#include <utility>

#include "talus/base/hash.h"
#include "talus/field/mesh_support.h"
#include "talus/io/digest.h"
#include "talus/io/mesh_reader.h"
#include "talus/io/tile_set_file.h"
#include "talus/scene/build_context.h"
#include "talus/scene/pile_file.h"

namespace talus {
namespace {

// Raise when the same parameters give other results than before: older cache entries then lapse.
constexpr int kTilesVersion = 2;
constexpr int kPileVersion = 2;

// The values of all fields, defaults too, so that a changed default changes the key.
template <Described T>
void add_params(Digest& digest, const T& params) {
  for (const KeyHelp& key : list_keys(params)) {
    digest.add(key.path);
    digest.add(key.default_value);
  }
}

void warn_about(const MeshSupportReport& report, const std::string& file, Job* job) {
  if (report.boundary_edges > 0)
    warn(job, fmt::format("{}: the mesh is open ({} edges with one triangle); its holes are closed "
                          "by its winding number",
                          file, report.boundary_edges));
  if (report.inverted) warn(job, fmt::format("{}: the mesh faces inward; it is turned", file));
  if (report.flipped > 0)
    warn(job, fmt::format("{}: {} triangles disagree with their neighbors; they are turned", file,
                          report.flipped));
  if (report.overlapping)
    warn(job, fmt::format("{}: the mesh crosses or overlaps itself; the union is filled", file));
  if (report.non_manifold_edges > 0)
    warn(job,
         fmt::format("{}: {} edges have more than two triangles", file, report.non_manifold_edges));
}

// A support that can be filled, and what identifies it.
struct Source {
  std::optional<TriangleMesh> mesh;
  std::optional<Shape> shape;
  std::string file;  // of the mesh, for messages
  std::string key;
};

Source open_source(const MeshSource& source, BuildContext& context, const std::string& name) {
  const StageTimer timer;
  ReadMeshResult read = read_mesh(source.mesh, source.read);
  for (const std::string& warning : read.warnings) warn(context.job, warning);
  Digest digest;
  digest.add(std::span(std::as_const(read.mesh.positions)));
  digest.add(std::span(std::as_const(read.mesh.triangles)));
  context.result.stages.push_back(timer.stop(name + ": read mesh"));
  return {.mesh = std::move(read.mesh), .file = source.mesh.string(), .key = digest.hex()};
}

Source open_source(const Shape& shape, BuildContext&, const std::string&) {
  return {.shape = shape, .key = to_text(write_value(shape))};
}

std::unique_ptr<const MeshSupport> mesh_support(const Source& source, Job* job) {
  try {
    return std::make_unique<const MeshSupport>(*source.mesh, job);
  } catch (const Error& error) {
    // The mesh does not know its file.
    throw Error(error.kind(), fmt::format("{}: {}", source.file, error.what()));
  }
}

FilledSupport fill_source(const Source& source, std::shared_ptr<const TileSet> tiles,
                          const PileParams& params, Job* job) {
  if (source.shape)
    return {.pile = fill(ShapeSupport(*source.shape), std::move(tiles), params, job)};
  const std::unique_ptr<const MeshSupport> support = mesh_support(source, job);
  return {.pile = fill(*support, std::move(tiles), params, job), .mesh = support->report()};
}

}  // namespace

std::string tile_key(const TileParams& params, std::uint64_t seed) {
  Digest digest;
  digest.add("tiles");
  digest.add(version());
  digest.add(kTilesVersion);
  digest.add(seed);
  add_params(digest, params);
  return digest.hex();
}

MadeTiles make_tiles(const TileParams& params, std::uint64_t seed, Cache& cache, Job* job) {
  const StageTimer timer;
  bool hit = false;
  auto tiles = cache.load_or_make(
      tile_key(params, seed) + ".tiles",
      [](const auto& path) { return std::make_shared<const TileSet>(load_tile_set(path)); },
      [&] { return std::make_shared<const TileSet>(TileSet::make(params, seed, job)); },
      [](const auto& path, const auto& made) { save_tile_set(path, *made); }, hit, job);
  return {std::move(tiles), timer.stop("tiles", hit)};
}

void run(const PileOperation& operation, BuildContext& context) {
  const std::string& name = operation.name;
  const std::uint64_t seed = context.result.recipe.seed;

  // A missing or broken file is found before the long work.
  const Source source =
      std::visit([&](const auto& s) { return open_source(s, context, name); }, operation.support);

  // Piles of the same stones share one tile set.
  const std::string tiles_key = tile_key(operation.tiles, seed);
  std::shared_ptr<const TileSet>& tiles = context.tile_sets[tiles_key];
  if (!tiles) {
    MadeTiles made = make_tiles(operation.tiles, seed, context.cache, context.job);
    tiles = std::move(made.tiles);
    made.stage.name = name + ": tiles";
    context.result.stages.push_back(std::move(made.stage));
    context.result.tile_sets.push_back(tiles);
  }

  Digest digest;
  digest.add("pile");
  digest.add(kPileVersion);
  digest.add(tiles_key);
  digest.add(source.key);
  add_params(digest, operation.pile);

  const StageTimer timer;
  bool hit = false;
  FilledSupport filled = context.cache.load_or_make(
      digest.hex() + ".pile", [&](const auto& path) { return load_pile(path, tiles); },
      [&] { return fill_source(source, tiles, operation.pile, context.job); }, save_pile, hit,
      context.job);
  context.result.stages.push_back(timer.stop(name + ": pile", hit));

  if (filled.mesh) warn_about(*filled.mesh, source.file, context.job);
  if (filled.pile.stats.isolated > 0)
    warn(context.job, fmt::format("{}: {} stones that would touch no other were left out", name,
                                  filled.pile.stats.isolated));
  context.result.piles.push_back({name, std::move(filled.pile)});
}

}  // namespace talus
