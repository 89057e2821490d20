#include <algorithm>
#include <utility>

#include "talus/base/hash.h"
#include "talus/field/joined_support.h"
#include "talus/io/mask_reader.h"
#include "talus/io/tile_set_file.h"
#include "talus/piles/pile_support.h"
#include "talus/rocks/deviation.h"
#include "talus/scene/build_context.h"
#include "talus/scene/pile_file.h"
#include "talus/scene/source.h"

namespace talus {
namespace {

// Raise when the same parameters give other results than before: older cache entries then lapse.
constexpr int kTilesVersion = 8;
constexpr int kPileVersion = 10;

void warn_about_deviation(const TileStats& stats, Job* job) {
  if (stats.deviation_bound <= rocks::kMuchDeviation) return;
  const std::string remedy = stats.sufficient_n
                                 ? fmt::format("n = {} leaves less than 5 %", *stats.sufficient_n)
                                 : "no n up to 9 leaves less than 5 %, less elongated stones do";
  warn(job, fmt::format("tiles: on {:.2g} % of space a stone too far away to compete could be "
                        "nearer; {}",
                        100 * stats.deviation_bound, remedy));
}

// What a pile keeps out and how densely it lies: sources first, which identify it, then what is
// made of them.
struct ControlSources {
  std::vector<Source> keep_out;
  std::vector<const Pile*> piles;
  std::optional<ColumnMask> mask;
  std::optional<Box2> mask_area;  // of a mask over the terrain
};

const NamedPile& pile_named(const std::string& name, const BuildResult& result) {
  std::vector<std::string> names;
  for (const NamedPile& named : result.piles) {
    if (named.name == name) return named;
    names.push_back(named.name);
  }
  throw usage_error(
      fmt::format("keep_out_piles: no pile \"{}\" comes before this one; {}", name,
                  names.empty() ? std::string("there is none at all") : suggest(name, names)));
}

ControlSources open_control(const PileControlSource& control, BuildContext& context,
                            const std::string& name, Digest& digest) {
  ControlSources sources;
  add_params(digest, control);
  for (const PileSource& support : control.keep_out) {
    sources.keep_out.push_back(
        std::visit([&](const auto& s) { return open_source(s, context, name); }, support));
    digest.add(sources.keep_out.back().key);
  }
  for (const std::string& other : control.keep_out_piles) {
    const NamedPile& named = pile_named(other, context.result);
    sources.piles.push_back(&named.pile);
    digest.add(named.key);
  }
  if (!control.density_mask) return sources;
  if (context.terrain) {
    const TerrainGrid& grid = context.terrain->terrain.grid();
    sources.mask = read_mask(*control.density_mask, grid.nx, grid.ny);
    sources.mask_area = Box2{{0, 0}, grid.cell * Vec2(grid.nx, grid.ny)};
  } else {
    sources.mask = read_mask(*control.density_mask);
  }
  digest.add(sources.mask->nx);
  digest.add(std::span<const float>(sources.mask->shares));
  return sources;
}

// The control and what it refers to.
struct MadeControl {
  std::unique_ptr<const JoinedSupport> keep_out;
  PileControl control;
};

MadeControl make_control(const PileControlSource& asked, const ControlSources& sources,
                         const Box3& bounds, Job* job) {
  std::vector<std::unique_ptr<const Support>> parts;
  for (const Source& source : sources.keep_out) {
    MadeSupport made = make_support(source, job);
    if (made.mesh) warn_about(*made.mesh, source.file, job);
    parts.push_back(std::move(made.support));
  }
  for (const Pile* pile : sources.piles) parts.push_back(std::make_unique<PileSupport>(*pile));

  MadeControl made;
  made.control.removed = asked.removed;
  made.control.locked = asked.locked;
  for (const MovedStoneSource& moved : asked.moved)
    made.control.moved.push_back({moved.stone, moved.by, moved.rotate_deg});
  if (sources.mask)
    made.control.density =
        DensityMask{.area = sources.mask_area.value_or(Box2{Vec2(bounds.min), Vec2(bounds.max)}),
                    .nx = sources.mask->nx,
                    .ny = sources.mask->ny,
                    .shares = sources.mask->shares};
  if (!parts.empty()) made.keep_out = std::make_unique<const JoinedSupport>(std::move(parts));
  made.control.keep_out = made.keep_out.get();
  return made;
}

// A stone's name is its cell, which is another place once the tiling lies elsewhere.
void warn_about_names(const PileOperation& operation, Job* job) {
  const PileControlSource& control = operation.control;
  if (control.removed.empty() && control.locked.empty() && control.moved.empty()) return;
  const bool is_fixed =
      operation.pile.tiling.at && operation.pile.stone_size.unit == RelativeLength::Unit::metres;
  if (!is_fixed)
    warn(job,
         fmt::format("{}: removed, locked and moved name stones by their cells, which move "
                     "with the support; give tiling.at, and stone_size in metres, to keep them",
                     operation.name));
}

void warn_about(const PileStats& stats, const std::string& name, Job* job) {
  if (stats.isolated > 0)
    warn(job, fmt::format("{}: stones that would touch no other are left out: {}", name,
                          stats.isolated));
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
  std::vector<Stage> phases;
  auto tiles = cache.load_or_make(
      tile_key(params, seed) + ".tiles",
      [](const auto& path) { return std::make_shared<const TileSet>(load_tile_set(path)); },
      [&] { return std::make_shared<const TileSet>(TileSet::make(params, seed, job, &phases)); },
      [](const auto& path, const auto& made) { save_tile_set(path, *made); }, hit, job);
  warn_about_deviation(tiles->stats(), job);
  Stage stage = timer.stop("tiles", hit);
  stage.phases = std::move(phases);
  return {std::move(tiles), std::move(stage)};
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

  warn_about_names(operation, context.job);

  Digest digest;
  digest.add("pile");
  digest.add(kPileVersion);
  digest.add(tiles_key);
  digest.add(source.key);
  add_params(digest, operation.pile);
  const ControlSources control = open_control(operation.control, context, name, digest);
  const std::string key = digest.hex();

  const StageTimer timer;
  bool hit = false;
  FilledSupport filled = context.cache.load_or_make(
      key + ".pile", [&](const auto& path) { return load_pile(path, tiles); },
      [&]() -> FilledSupport {
        const MadeSupport made = make_support(source, context.job);
        PileParams params = operation.pile;
        params.memory_limit = context.memory_limit;
        const MadeControl limits =
            make_control(operation.control, control, made.support->bounds(), context.job);
        return {fill(*made.support, tiles, params, limits.control, context.job), made.mesh};
      },
      save_pile, hit, context.job);
  context.result.stages.push_back(timer.stop(name + ": pile", hit));

  if (filled.mesh) warn_about(*filled.mesh, source.file, context.job);
  warn_about(filled.pile.stats, name, context.job);
  context.result.piles.push_back(
      {name, std::move(filled.pile), std::holds_alternative<LayerSource>(operation.support), key});
}

}  // namespace talus
