#include <algorithm>
#include <utility>

#include "talus/base/hash.h"
#include "talus/io/tile_set_file.h"
#include "talus/rocks/deviation.h"
#include "talus/scene/build_context.h"
#include "talus/scene/pile_file.h"
#include "talus/scene/source.h"

namespace talus {
namespace {

// Raise when the same parameters give other results than before: older cache entries then lapse.
constexpr int kTilesVersion = 7;
constexpr int kPileVersion = 8;

void warn_about_deviation(const TileStats& stats, Job* job) {
  if (stats.deviation_bound <= rocks::kMuchDeviation) return;
  const std::string remedy = stats.sufficient_n
                                 ? fmt::format("n = {} leaves less than 5 %", *stats.sufficient_n)
                                 : "no n up to 9 leaves less than 5 %, less elongated stones do";
  warn(job, fmt::format("tiles: on {:.2g} % of space a stone too far away to compete could be "
                        "nearer; {}",
                        100 * stats.deviation_bound, remedy));
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
      [&]() -> FilledSupport {
        const MadeSupport made = make_support(source, context.job);
        PileParams params = operation.pile;
        params.memory_limit = context.memory_limit;
        return {fill(*made.support, tiles, params, context.job), made.mesh};
      },
      save_pile, hit, context.job);
  context.result.stages.push_back(timer.stop(name + ": pile", hit));

  if (filled.mesh) warn_about(*filled.mesh, source.file, context.job);
  if (filled.pile.stats.isolated > 0)
    warn(context.job, fmt::format("{}: stones that would touch no other are left out: {}", name,
                                  filled.pile.stats.isolated));
  context.result.piles.push_back(
      {name, std::move(filled.pile), std::holds_alternative<LayerSource>(operation.support)});
}

}  // namespace talus
