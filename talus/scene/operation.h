// What a recipe can do: the operations and their keys.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "talus/base/describe.h"
#include "talus/io/raster_reader.h"
#include "talus/piles/pile.h"
#include "talus/rocks/tile_params.h"
#include "talus/scene/fields.h"
#include "talus/scene/pile_fields.h"
#include "talus/scene/support_source.h"
#include "talus/scene/terrain_fields.h"
#include "talus/scene/tile_fields.h"
#include "talus/tools/cover.h"
#include "talus/tools/deposit.h"
#include "talus/tools/erode_surface.h"
#include "talus/tools/fill_support.h"
#include "talus/tools/noise_terrain.h"
#include "talus/tools/sculpt.h"
#include "talus/tools/set_surface.h"
#include "talus/tools/sweep.h"

namespace talus {

constexpr Field kVariantField{
    .name = "variant", .help = "another number, another noise of the same kind", .min = 0};

// A terrain's surface from a raster of heights. The first operation on a terrain sets its extent
// unless the recipe's [terrain] does.
struct HeightmapOperation {
  std::filesystem::path file;
  ReadRasterParams read;
  SetSurfaceParams surface;

  static constexpr std::string_view kName = "heightmap";
  static constexpr std::string_view kHelp = "gives the terrain the heights of a raster";
  static void describe(auto& p, auto&& field) {
    field(p.file, Field{.name = "file", .help = "the raster, relative to the recipe"});
    ReadRasterParams::describe(p.read, field);
    SetSurfaceParams::describe(p.surface, field);
  }
};

// A terrain's surface from noise.
struct NoiseTerrainOperation {
  NoiseTerrainParams noise;
  SetSurfaceParams surface;
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "noise_terrain";
  static constexpr std::string_view kHelp = "gives the terrain heights that noise makes up";
  static void describe(auto& p, auto&& field) {
    NoiseTerrainParams::describe(p.noise, field);
    SetSurfaceParams::describe(p.surface, field);
    field(p.variant, kVariantField);
  }
};

// A shape or a mesh where it is, filled with a material or emptied.
struct PrimitiveOperation {
  SupportSource support;
  FillParams fill;
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "primitive";
  static constexpr std::string_view kHelp =
      "fills a shape within the terrain with a material, or empties it; whatever is no bedrock "
      "then "
      "comes down onto what is below";
  static void describe(auto& p, auto&& field) {
    field(p.support, Field{.name = "support", .help = "what is filled"});
    FillParams::describe(p.fill, field);
    field(p.variant, kVariantField);
  }
};

// A mesh, placed, becomes part of the ground.
struct MeshBedrockOperation {
  MeshSource mesh;
  Placement placement;
  FillParams fill{.material = Material::bedrock};
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "mesh_bedrock";
  static constexpr std::string_view kHelp = "turns a mesh into bedrock or another material";
  static void describe(auto& p, auto&& field) {
    MeshSource::describe(p.mesh, field);
    Placement::describe(p.placement, field);
    FillParams::describe(p.fill, field);
    field(p.variant, kVariantField);
  }
};

// Loose matter on everything that is flat enough.
struct CoverOperation {
  CoverParams cover;
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "cover";
  static constexpr std::string_view kHelp =
      "lays sand, soil or snow on all ground that is flat enough to hold it";
  static void describe(auto& p, auto&& field) {
    CoverParams::describe(p.cover, field);
    field(p.variant, kVariantField);
  }
};

// A stroke with a brush over the bedrock's surface.
struct SculptOperation {
  std::vector<SurfacePoint> points;
  StrokeParams stroke;

  static constexpr std::string_view kName = "sculpt";
  static constexpr std::string_view kHelp =
      "adds or carves bedrock along its surface's normal, dab by dab along a stroke";
  static void describe(auto& p, auto&& field) {
    field(p.points, Field{.name = "points",
                          .help = "where the stroke goes; a point without z is on the topmost "
                                  "bedrock",
                          .unit = "m"});
    StrokeParams::describe(p.stroke, field);
  }
};

// A profile swept along paths, filled with a material or emptied.
struct SweepOperation {
  SweepParams sweep;
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "sweep";
  static constexpr std::string_view kHelp =
      "carves or fills what a profile passes through on its way along branching paths: gorges, "
      "cliffs, tunnels, bridges; whatever is no bedrock then comes down onto what is below";
  static void describe(auto& p, auto&& field) {
    SweepParams::describe(p.sweep, field);
    field(p.variant, kVariantField);
  }
};

// Where a brush works: a stroke and a painted mask, or one of them.
struct BrushSource {
  std::vector<SurfacePoint> points;
  std::optional<std::filesystem::path> mask;

  static void describe_points(auto& p, auto&& field, std::string_view help) {
    field(p.points, Field{.name = "points", .help = help, .unit = "m"});
    field(p.mask, Field{.name = "mask",
                        .help = "grey picture, relative to the recipe, a pixel for each column, "
                                "north up: nothing happens where it is black; without points the "
                                "brush is everywhere"});
  }
};

// Matter from a brush.
struct DepositOperation {
  BrushSource region;
  DepositParams deposit;
  std::optional<std::filesystem::path> map;
  std::uint64_t variant = 0;

  static constexpr std::string_view kName = "deposit";
  static constexpr std::string_view kHelp =
      "drops a material from a brush, or takes it away with it";
  static void describe(auto& p, auto&& field) {
    BrushSource::describe_points(p.region, field,
                                 "where the stroke goes; from a point without z the material falls "
                                 "from the sky, also onto a wall's ledges, else from that height. "
                                 "It stays where it falls, nothing slides");
    DepositParams::describe(p.deposit, field);
    field(p.map, Field{.name = "map",
                       .help = "raster of heights, relative to the recipe, for profile = \"map\": "
                               "its lowest is nothing, its highest `height`; it is stretched over "
                               "the square that reaches `radius` from a dab along x and y"});
    field(p.variant, kVariantField);
  }
};

// Bedrock that weathers to sand under a brush.
struct ErodeSurfaceOperation {
  BrushSource region;
  ErodeSurfaceParams erosion;

  static constexpr std::string_view kName = "erode_surface";
  static constexpr std::string_view kHelp =
      "turns the surface of bedrock into sand where a brush goes over it";
  static void describe(auto& p, auto&& field) {
    BrushSource::describe_points(p.region, field,
                                 "where the stroke goes; a point without z is on the topmost "
                                 "bedrock");
    ErodeSurfaceParams::describe(p.erosion, field);
  }
};

// Fills a support with the stones of a tile set.
struct PileOperation {
  std::string name = "stones";
  PileSource support;
  TileParams tiles;
  PileParams pile;
  PileControlSource control;

  static constexpr std::string_view kName = "pile";
  static constexpr std::string_view kHelp =
      "fills a mesh, a shape or the terrain's layers with stones that touch";
  static void describe(auto& p, auto&& field) {
    field(p.support, Field{.name = "support", .help = "what is filled"});
    PileParams::describe(p.pile, field);
    PileControlSource::describe(p.control, field);
    field(p.tiles, Field{.name = "tiles", .help = "the stones it is filled with"});
    field(p.name, Field{.name = "name", .help = "what messages and the report call it"});
  }
};

// One entry of a recipe's list.
struct Operation {
  std::variant<HeightmapOperation, NoiseTerrainOperation, PrimitiveOperation, MeshBedrockOperation,
               CoverOperation, SculptOperation, SweepOperation, DepositOperation,
               ErodeSurfaceOperation, PileOperation>
      params;
  std::string where;  // it was written, "scene.toml:13"; empty if made by the program
};

// What messages about an operation begin with, "scene.toml:13: operation.pile", without what is
// empty.
std::string place_of(const Operation& operation);

// A message about an operation behind a place that ends with the operation's name. Tools begin what
// they say with their own name, which is not said twice: "sculpt.points: ..." goes on from
// "scene.toml:13: operation.sculpt" as ".points: ...".
std::string told_at(const std::string& place, std::string_view message);

// Throws `Error` (usage) for what single keys cannot tell: a missing file or support, parameters
// that contradict each other, a material that the operation cannot use.
void check(const Operation& operation);

// One line of the table of operations.
struct OperationType {
  std::string_view name;
  std::string_view help;
  Operation defaults;
};

// Every operation there is.
std::span<const OperationType> operation_types();

// The keys below `type` in an [[operation]] table.
std::vector<KeyHelp> list_keys(const OperationType& type);

void read_value(const Value& value, const std::string& path, Operation& out);
Value write_value(const Operation& operation);
std::string type_name(const Operation&);

}  // namespace talus
