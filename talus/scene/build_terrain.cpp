#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "talus/io/mask_reader.h"
#include "talus/scene/build_context.h"
#include "talus/scene/source.h"
#include "talus/scene/terrain_file.h"
#include "talus/settle/layer_order.h"
#include "talus/tools/stroke.h"

namespace talus {
namespace {

// Raise when the same operations give other terrain than before: older cache entries then lapse.
constexpr int kTerrainVersion = 6;

constexpr double kCellDefault = 0.5;
constexpr Vec2 kSizeDefault{100, 100};
constexpr double kAlignedShare = 0.01;  // of a cell that a raster may lie beside the columns

// The share of columns that the ground mesh may lose without a word: rough overhangs have tips that
// are too thin for it.
constexpr double kLostShare = 5e-4;

// What a column takes in memory until its mesh is written: a few layers, and the vertices,
// triangles and scratch of its surface.
constexpr double kBytesPerColumn = 200;

std::string in_words(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

// Throws if the terrain, or a finer mesh of it, would take more than is allowed.
void check_memory(const TerrainGrid& grid, const BuildContext& context) {
  const double mesh_cell =
      std::min(context.result.recipe.ground.cell.value_or(grid.cell), grid.cell);
  const double finer = grid.cell / mesh_cell;
  const double nx = std::round(grid.nx * finer), ny = std::round(grid.ny * finer);
  const double bytes = kBytesPerColumn * nx * ny, limit = static_cast<double>(context.memory_limit);
  if (bytes <= limit) return;
  throw job_error(
      fmt::format("a {} of {} x {} {} takes about {}, but only {} may be used; choose "
                  "larger cells, {:.3g} m for example",
                  finer > 1 ? "ground mesh" : "terrain", nx, ny, finer > 1 ? "cells" : "columns",
                  in_words(bytes), in_words(limit), 1.1 * mesh_cell * std::sqrt(bytes / limit)));
}

int count_cells(double length, double cell, const char* axis) {
  const double count = std::round(length / cell);
  if (!(count >= 1 && count <= 1 << 24))
    throw usage_error(
        fmt::format("terrain: {} m along {} are {:.3g} cells of {} m; there can be 1 "
                    "to {}",
                    length, axis, count, cell, 1 << 24));
  return static_cast<int>(count);
}

// The columns that the recipe asks for, or the defaults; the floor is still open.
TerrainGrid grid_of(const TerrainParams& params) {
  const double cell = params.cell.value_or(kCellDefault);
  const Vec2 size = params.size.value_or(kSizeDefault);
  return {.nx = count_cells(size.x, cell, "x"),
          .ny = count_cells(size.y, cell, "y"),
          .cell = cell,
          .step = params.step};
}

// A terrain of those columns, empty, with a floor that suits its lowest ground.
TerrainState start_terrain(TerrainGrid grid, double lowest, BuildContext& context) {
  check_memory(grid, context);
  const TerrainParams& params = context.result.recipe.terrain;
  grid.floor = floor_below(lowest, grid);
  if (params.floor) {
    const double steps = std::floor(*params.floor / params.step);
    if (!(std::abs(steps) <= kStepsMax))
      throw usage_error(fmt::format("terrain.floor = {} m is {:.3g} steps of {} m; there can be {}",
                                    *params.floor, steps, params.step, kStepsMax));
    grid.floor = static_cast<Steps>(steps);
  }
  Digest digest;
  digest.add("terrain");
  digest.add(version());
  digest.add(kTerrainVersion);
  for (const double value : {grid.cell, grid.step}) digest.add(value);
  for (const int value : {grid.nx, grid.ny, grid.floor}) digest.add(value);
  return {.terrain = LayeredTerrain(grid), .key = digest.hex()};
}

// The terrain to work on; the first operation finds level bedrock up to height 0.
TerrainState& terrain_of(BuildContext& context) {
  if (!context.terrain) {
    TerrainState state = start_terrain(grid_of(context.result.recipe.terrain), 0, context);
    state.terrain.edit([](int, int, ColumnEditor& column) {
      column.replace(column.floor(), 0, Material::bedrock);
    });
    context.terrain = std::move(state);
  }
  return *context.terrain;
}

// Runs one operation on the terrain, from the cache if it is there: `change` edits, deposits are
// put in order, and the ledger gets its entry. `inputs` identify all that the change depends on
// besides the terrain.
void change_terrain(BuildContext& context, std::string_view name, const Digest& inputs,
                    const std::function<Booking(LayeredTerrain&)>& change) {
  TerrainState& state = *context.terrain;
  Digest digest;
  digest.add(state.key);
  digest.add(name);
  digest.add(inputs.hex());
  state.key = digest.hex();

  const StageTimer timer;
  bool hit = false;
  TerrainStage stage = context.cache.load_or_make(
      state.key + ".terrain", load_terrain,
      [&]() -> TerrainStage {
        LayeredTerrain terrain = state.terrain;
        Booking booking = change(terrain);
        booking.add(sort_layers(terrain, context.job));
        const MaterialSteps before = state.terrain.volume(), after = terrain.volume();
        const MaterialSteps booked = booking.change();
        bool balanced = true;
        for (std::size_t m = 0; m < after.size(); ++m)
          balanced = balanced && after[m] - before[m] == booked[m];
        return {std::move(terrain), booking, balanced};
      },
      save_terrain, hit, context.job);
  state.terrain = std::move(stage.terrain);
  state.ledger.push_back({std::string(name), stage.booking, stage.balanced});
  context.result.stages.push_back(timer.stop(std::string(name), hit));
}

// Another noise for each variant.
std::uint64_t noise_seed(const BuildContext& context, std::uint64_t variant) {
  return hash(context.result.recipe.seed, Purpose::gradient_noise, variant);
}

void add_heights(Digest& digest, const HeightGrid& heights) {
  digest.add(heights.nx);
  digest.add(heights.ny);
  digest.add(heights.cell);
  digest.add(std::span(heights.heights));
}

BrushRegion read_region(const BrushSource& source, const TerrainGrid& grid) {
  BrushRegion region{.points = source.points};
  if (source.mask) region.mask = read_mask(*source.mask, grid.nx, grid.ny);
  return region;
}

void add_region(Digest& digest, const BrushRegion& region) {
  digest.add(to_text(write_value(region.points)));
  if (!region.mask) return;
  digest.add(region.mask->nx);
  digest.add(region.mask->ny);
  digest.add(std::span<const float>(region.mask->shares));
}

// Tells how much of a volume found no room, or was not there.
void warn_of_rest(const DepositParams& params, bool is_stroke, BuildContext& context) {
  const TerrainGrid& grid = context.terrain->terrain.grid();
  const Booking& booking = context.terrain->ledger.back().booking;
  const std::int64_t moved =
      params.remove ? booking.removed(params.material) : booking.added(params.material);
  const double sure_radius = std::sqrt(0.5) * grid.cell;
  if (moved == 0 && is_stroke && params.brush.radius < sure_radius)
    warn(context.job,
         fmt::format("deposit: nothing of {:.6g} m^3 was moved: a brush of radius {:.4g} m may lie "
                     "between the columns' middles, from {:.4g} m on it always meets one",
                     *params.volume, params.brush.radius, sure_radius));
  else if (moved < steps_of_volume(grid, *params.volume))
    warn(context.job, fmt::format("deposit: only {:.6g} of {:.6g} m^3 of {} {}",
                                  static_cast<double>(moved) * grid.cell * grid.cell * grid.step,
                                  *params.volume, material_info(params.material).name,
                                  params.remove ? "lay there" : "found room"));
}

template <class Params>
void check_place(const TerrainGrid&, const Params&) {}
void check_place(const TerrainGrid& grid, const SculptOperation& o) {
  for (const SurfacePoint& point : o.points) check_inside(grid, point.at, o.kName);
}
void check_place(const TerrainGrid& grid, const DepositOperation& o) {
  for (const SurfacePoint& point : o.region.points) check_inside(grid, point.at, o.kName);
}
void check_place(const TerrainGrid& grid, const ErodeSurfaceOperation& o) {
  for (const SurfacePoint& point : o.region.points) check_inside(grid, point.at, o.kName);
}
void check_place(const TerrainGrid& grid, const SweepOperation& o) {
  check_within_reach(grid, o.sweep);
}

// Gives the terrain these heights, as a stage of that name.
void set_heights(BuildContext& context, std::string_view name, const HeightGrid& heights,
                 const SetSurfaceParams& params) {
  Digest digest;
  add_heights(digest, heights);
  add_params(digest, params);
  digest.add(params.x_begin);
  digest.add(params.y_begin);
  change_terrain(context, name, digest, [&](LayeredTerrain& terrain) {
    return set_surface(terrain, heights, params, context.job);
  });
}

// The columns from the terrain's south-west corner to that of another raster, along one axis.
int columns_between(double from, double to, double cell) {
  const double columns = std::round((to - from) / cell);
  if (!(std::abs(columns) <= 1 << 28)) throw usage_error("the raster lies far outside the terrain");
  return static_cast<int>(columns);
}

// Where a raster lies on a terrain that another one placed on Earth.
void place_raster(const std::string& file, const Georeference& raster, const TerrainState& state,
                  SetSurfaceParams& params, Job* job) {
  const Georeference& terrain = state.georeference;
  if (raster.crs.empty() || terrain.crs.empty()) return;
  if (raster.crs != terrain.crs)
    throw usage_error(
        fmt::format("{}: the raster comes to lie in {}, the terrain is in {}; "
                    "reproject it first",
                    file, raster.crs, terrain.crs));
  const double cell = state.terrain.grid().cell;
  params.x_begin = columns_between(terrain.offset.x, raster.offset.x, cell);
  params.y_begin = columns_between(terrain.offset.y, raster.offset.y, cell);
  const Vec2 moved = cell * Vec2(params.x_begin, params.y_begin) - (raster.offset - terrain.offset);
  if (std::max(std::abs(moved.x), std::abs(moved.y)) > kAlignedShare * cell)
    warn(job, fmt::format("{}: its cells lie between the terrain's columns; it is moved by "
                          "({:.3g}, {:.3g}) m",
                          file, moved.x, moved.y));
}

void fill_source(const Source& source, const FillParams& params, std::uint64_t seed,
                 std::string_view name, BuildContext& context) {
  terrain_of(context);
  Digest digest;
  digest.add(source.key);
  digest.add(seed);
  add_params(digest, params);
  // What is unusual about a mesh is told also when the result is known.
  const MadeSupport made = make_support(source, context.job);
  if (made.mesh) warn_about(*made.mesh, source.file, context.job);
  change_terrain(context, name, digest, [&](LayeredTerrain& terrain) {
    return fill_support(terrain, *made.support, params, seed, context.job);
  });
}

// Layers of rocks show by their stones alone.
void warn_about_bare_rocks(const TerrainState& state, const BuildContext& context) {
  const auto& piles = context.result.piles;
  const bool filled = std::any_of(piles.begin(), piles.end(),
                                  [](const NamedPile& pile) { return pile.in_terrain; });
  if (!filled && state.terrain.volume()[index(Material::rocks)] > 0)
    warn(context.job,
         "the terrain's rocks do not show, because no pile fills them; add an operation of type "
         "\"pile\" with support = \"rocks\"");
}

}  // namespace

void run(const HeightmapOperation& operation, BuildContext& context) {
  const TerrainParams& wanted = context.result.recipe.terrain;
  const StageTimer timer;
  ReadRasterParams params = operation.read;
  params.memory_limit = context.memory_limit;
  std::optional<double> columns = wanted.cell;
  if (context.terrain) columns = context.terrain->terrain.grid().cell;
  if (columns && params.cell && *params.cell != *columns)
    throw usage_error(
        fmt::format("cell = {} m, but the terrain's columns are {} m wide; leave it out, or say by "
                    "pixel_size what the raster's pixels are",
                    *params.cell, *columns));
  if (columns) params.cell = columns;
  ReadRasterResult read = read_raster(operation.file, params, context.job);
  for (const std::string& warning : read.warnings) warn(context.job, warning);
  context.result.stages.push_back(timer.stop("heightmap: read"));

  SetSurfaceParams surface = operation.surface;
  if (context.terrain) {
    place_raster(operation.file.string(), read.georeference, *context.terrain, surface,
                 context.job);
  } else {
    TerrainGrid grid{
        .nx = read.grid.nx, .ny = read.grid.ny, .cell = read.grid.cell, .step = wanted.step};
    if (wanted.size) {
      grid.nx = count_cells(wanted.size->x, grid.cell, "x");
      grid.ny = count_cells(wanted.size->y, grid.cell, "y");
    }
    context.terrain = start_terrain(grid, lowest_height(read.grid).value_or(0), context);
    context.terrain->georeference = std::move(read.georeference);
  }
  set_heights(context, HeightmapOperation::kName, read.grid, surface);
}

void run(const NoiseTerrainOperation& operation, BuildContext& context) {
  const TerrainGrid grid =
      context.terrain ? context.terrain->terrain.grid() : grid_of(context.result.recipe.terrain);
  check_memory(grid, context);
  const HeightGrid heights = noise_heights(grid.nx, grid.ny, grid.cell, operation.noise,
                                           noise_seed(context, operation.variant), context.job);
  if (!context.terrain)
    context.terrain = start_terrain(grid, lowest_height(heights).value_or(0), context);
  set_heights(context, NoiseTerrainOperation::kName, heights, operation.surface);
}

void run(const PrimitiveOperation& operation, BuildContext& context) {
  const std::string name(PrimitiveOperation::kName);
  const Source source =
      std::visit([&](const auto& s) { return open_source(s, context, name); }, operation.support);
  fill_source(source, operation.fill, noise_seed(context, operation.variant), name, context);
}

void run(const MeshBedrockOperation& operation, BuildContext& context) {
  const std::string name(MeshBedrockOperation::kName);
  const Source source = open_source(operation.mesh, context, name, operation.placement);
  fill_source(source, operation.fill, noise_seed(context, operation.variant), name, context);
}

void run(const CoverOperation& operation, BuildContext& context) {
  terrain_of(context);
  const std::uint64_t seed =
      hash(context.result.recipe.seed, Purpose::cover_patches, operation.variant);
  Digest digest;
  digest.add(seed);
  add_params(digest, operation.cover);
  change_terrain(context, CoverOperation::kName, digest, [&](LayeredTerrain& terrain) {
    return cover(terrain, operation.cover, seed, context.job);
  });
}

void run(const SculptOperation& operation, BuildContext& context) {
  terrain_of(context);
  Digest digest;
  add_params(digest, operation);
  change_terrain(context, SculptOperation::kName, digest, [&](LayeredTerrain& terrain) {
    return sculpt(terrain, operation.points, operation.stroke, context.job);
  });
}

void run(const SweepOperation& operation, BuildContext& context) {
  terrain_of(context);
  const std::uint64_t seed = noise_seed(context, operation.variant);
  Digest digest;
  digest.add(seed);
  add_params(digest, operation.sweep);
  change_terrain(context, SweepOperation::kName, digest, [&](LayeredTerrain& terrain) {
    return sweep(terrain, operation.sweep, seed, context.job);
  });
}

void run(const DepositOperation& operation, BuildContext& context) {
  const TerrainGrid& grid = terrain_of(context).terrain.grid();
  const BrushRegion region = read_region(operation.region, grid);
  DepositParams params = operation.deposit;
  if (operation.map) {
    const ReadRasterParams read{.memory_limit = context.memory_limit};
    params.map = read_raster(*operation.map, read, context.job).grid;
  }
  const std::uint64_t seed = noise_seed(context, operation.variant);
  Digest digest;
  digest.add(seed);
  add_region(digest, region);
  add_params(digest, params);
  add_heights(digest, params.map);
  change_terrain(context, DepositOperation::kName, digest, [&](LayeredTerrain& terrain) {
    return deposit(terrain, region, params, seed, context.job);
  });
  if (params.volume) warn_of_rest(params, !region.points.empty(), context);
}

void run(const ErodeSurfaceOperation& operation, BuildContext& context) {
  const TerrainGrid& grid = terrain_of(context).terrain.grid();
  const BrushRegion region = read_region(operation.region, grid);
  Digest digest;
  add_region(digest, region);
  add_params(digest, operation.erosion);
  change_terrain(context, ErodeSurfaceOperation::kName, digest, [&](LayeredTerrain& terrain) {
    return erode_surface(terrain, region, operation.erosion, context.job);
  });
}

std::optional<TerrainGrid> known_grid(const Recipe& recipe) {
  for (const Operation& operation : recipe.operations) {
    const auto* raster = std::get_if<HeightmapOperation>(&operation.params);
    if (!raster && std::holds_alternative<PileOperation>(operation.params)) continue;
    TerrainParams params = recipe.terrain;
    if (raster && !params.cell) params.cell = raster->read.cell;
    if (raster && !(params.size && params.cell)) return std::nullopt;
    return grid_of(params);
  }
  return std::nullopt;
}

void check_places(const Operation& operation, const TerrainGrid& grid) {
  std::visit([&](const auto& params) { check_place(grid, params); }, operation.params);
}

void finish_terrain(BuildContext& context) {
  if (!context.terrain) return;
  const StageTimer timer;
  TerrainState& state = *context.terrain;
  warn_about_bare_rocks(state, context);
  const GroundMeshParams& params = context.result.recipe.ground;
  GroundMesh ground = make_ground_mesh(state.terrain, params, context.job);
  const double column = state.terrain.grid().cell;
  const double spacing = std::max(params.cell.value_or(0), column);
  const double sigma = params.sigma.value_or(spacing);
  const auto columns = static_cast<double>(state.terrain.column_count());
  if (static_cast<double>(ground.columns_lost) > kLostShare * columns)
    warn(context.job,
         fmt::format("ground mesh: {} of {} columns ({:.2g} %) end in tips, walls or slabs thinner "
                     "than about {:.3g} m, which it leaves out; thicker forms or {} = {:.3g} would "
                     "show more of them",
                     ground.columns_lost, columns,
                     100 * static_cast<double>(ground.columns_lost) / columns, sigma,
                     sigma > column ? "ground.cell" : "terrain.cell",
                     sigma > column ? column : 0.5 * column));
  TriangleMesh water =
      make_water_surface(state.terrain, ground.origin, {.bank = sigma}, context.job);
  context.result.stages.push_back(timer.stop("ground mesh"));
  context.result.terrain = TerrainResult{.terrain = std::move(state.terrain),
                                         .ledger = std::move(state.ledger),
                                         .georeference = std::move(state.georeference),
                                         .ground = std::move(ground),
                                         .water = std::move(water)};
}

}  // namespace talus
