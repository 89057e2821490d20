// A scene as an author writes it: a seed and an ordered list of operations.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "talus/base/describe.h"
#include "talus/base/view_params.h"
#include "talus/scene/fields.h"
#include "talus/scene/operation.h"
#include "talus/scene/output_params.h"
#include "talus/scene/surface_params.h"
#include "talus/terrain/ground_mesh.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<CameraPreset> =
    std::to_array<EnumName<CameraPreset>>({{CameraPreset::overview, "overview"},
                                           {CameraPreset::low, "low"},
                                           {CameraPreset::inside, "inside"}});

// The terrain's columns. What is not given, the first operation on the terrain decides.
struct TerrainParams {
  std::optional<Vec2> size;
  std::optional<double> cell;
  double step = TerrainGrid{}.step;
  std::optional<double> floor;

  static void describe(auto& p, auto&& field) {
    field(p.size, Field{.name = "size",
                        .help = "extent to the east and to the north, from the corner at (0, 0); "
                                "by default that of the first operation's raster, else [100, 100]",
                        .unit = "m",
                        .min = 1e-3,
                        .max = 1e7});
    field(p.cell, Field{.name = "cell",
                        .help = "edge of a column; by default the spacing of the first "
                                "operation's raster, else 0.5",
                        .unit = "m",
                        .min = 1e-3,
                        .max = 1e6});
    field(p.step, Field{.name = "step",
                        .help = "the unit in which heights are counted",
                        .unit = "m",
                        .min = 1e-6,
                        .max = 1e3});
    field(p.floor, Field{.name = "floor",
                         .help = "height below which nothing is dug; by default a tenth of the "
                                 "longest side below the lowest ground of the first operation",
                         .unit = "m",
                         .min = -1e5,
                         .max = 1e5});
  }
};

struct Recipe {
  std::uint64_t seed = 1;
  TerrainParams terrain;
  GroundMeshParams ground;
  std::vector<Operation> operations;
  OutputParams output;
  ViewParams view;
  SurfacesParams surfaces;

  static void describe(auto& p, auto&& field) {
    field(p.seed, Field{.name = "seed", .help = "which of the possible scenes this is", .min = 0});
    field(p.terrain, Field{.name = "terrain", .help = "the columns that the ground is made of"});
    field(p.ground, Field{.name = "ground", .help = "the mesh of the terrain's surface"});
    field(p.operations, Field{.name = "operation", .help = "what is done, in order"});
    field(p.output, Field{.name = "output", .help = "what is written"});
    field(p.view, Field{.name = "view", .help = "how the preview is taken"});
    field(p.surfaces,
          Field{.name = "surfaces", .help = "how the ground's materials look in pictures"});
  }
};

// Reads a view whose keys agree. Throws `Error` (usage), besides what single fields refuse, for an
// eye without a target or a target without an eye, a camera inside without them, and for keys that
// another one leaves without effect: azimuth, elevation and zoom beside an eye, elevation and zoom
// beside a low camera.
void read_value(const Value& value, const std::string& path, ViewParams& out);

// Gives a document its meaning. Relative file names start at `folder`; in the recipe they are as
// the program opens them. Throws `Error` (usage), one line with file, line, key and what would be
// right, for anything that is unknown, of the wrong type, out of range or missing.
Recipe read_recipe(const Value& document, const std::filesystem::path& folder = {});

// Reads a file, lets `change` set values in it, gives it its meaning. Throws `Error` (input) if the
// file cannot be read, else as `read_recipe`.
Recipe load_recipe(const std::filesystem::path& file,
                   const std::function<Value(Value)>& change = std::identity());

// The recipe as TOML: its seed, its operations, and every key that differs from its default.
// `read_recipe` with the same folder gives the same recipe again. Throws `Error` (usage) for a seed
// above 2^63 - 1, the largest integer of TOML.
std::string to_toml(const Recipe& recipe, const std::filesystem::path& folder = {});

}  // namespace talus
