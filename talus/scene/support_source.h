// Supports, as a recipe says them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "talus/base/describe.h"
#include "talus/field/shape.h"
#include "talus/io/mesh_reader.h"
#include "talus/io/raster_reader.h"
#include "talus/scene/fields.h"
#include "talus/scene/terrain_fields.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<Axis> =
    std::to_array<EnumName<Axis>>({{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}});

// A mesh file, for example { mesh = "angel.ply", up = "z", scale = 0.1 }.
struct MeshSource {
  std::filesystem::path mesh;  // relative to the recipe until the recipe is read, then as opened
  ReadMeshParams read;

  static void describe(auto& p, auto&& field) {
    field(p.mesh, Field{.name = "mesh", .help = "mesh file, relative to the recipe"});
    ReadMeshParams::describe(p.read, field);
  }
};

// A condition on x, y and z within a box, see `FormulaSupport`; its noise follows the recipe's
// seed: { formula = "z < 0.2 * sin(x)", min = [0, 0, 0], max = [4, 4, 1] }.
struct FormulaSource {
  std::string formula;
  Vec3 min{0};
  Vec3 max{0};

  static void describe(auto& p, auto&& field) {
    field(p.formula, Field{.name = "formula", .help = "what holds inside, in x, y and z"});
    field(p.min, place_field("min", "lower corner of the box that the formula is asked in"));
    field(p.max, place_field("max", "its upper corner"));
  }
};

// Between the surfaces of two rasters of the same cells, which are read alike; unknown heights
// leave nothing: { lower = "bed.tif", upper = "top.tif" }.
struct HeightsSource {
  std::filesystem::path lower;  // relative to the recipe until the recipe is read, then as opened
  std::filesystem::path upper;
  ReadRasterParams read;

  static void describe(auto& p, auto&& field) {
    field(p.lower, Field{.name = "lower",
                         .help = "raster of the lower surface, relative to the "
                                 "recipe"});
    field(p.upper, Field{.name = "upper", .help = "raster of the upper surface"});
    ReadRasterParams::describe(p.read, field);
  }
};

// A mesh file, a formula, two rasters or a shape: { shape = "sphere", radius = 2 },
// { shape = "join", blend = 0.1, parts = [{ shape = "box" }, ...] }.
using SupportSource = std::variant<MeshSource, Shape, FormulaSource, HeightsSource>;

// The terrain's layers of a material: "rocks".
struct LayerSource {
  Material material = Material::rocks;
};

// What a pile may fill: a support, or layers of the terrain as it is then.
using PileSource = std::variant<MeshSource, Shape, FormulaSource, HeightsSource, LayerSource>;

// Where a mesh is put: turned about its own origin, first about x, then y, then z, then moved.
struct Placement {
  Vec3 rotate_deg{0};
  Vec3 at{0};

  static void describe(auto& p, auto&& field) {
    field(p.rotate_deg, Field{.name = "rotate_deg",
                              .help = "turns about the x, y and z axes, in this order",
                              .unit = "degrees",
                              .min = -360,
                              .max = 360});
    field(p.at, place_field("at", "where the mesh's origin comes to lie"));
  }
};

void read_value(const Value& value, const std::string& path, SupportSource& out);
void read_value(const Value& value, const std::string& path, PileSource& out);
void read_value(const Value& value, const std::string& path, Shape& out);
// Reads the formula, too.
void read_value(const Value& value, const std::string& path, FormulaSource& out);
void read_value(const Value& value, const std::string& path, HeightsSource& out);
Value write_value(const SupportSource& source);
Value write_value(const PileSource& source);
Value write_value(const Shape& shape);
std::string type_name(const SupportSource&);
std::string type_name(const PileSource&);

// A support as one word of a command line: a shape's name and its keys ("sphere",
// "capsule:to=[0, 0, 2], to_radius=0.1"), else a mesh file's name. The value's place is `where`.
// Throws `Error` (usage) if the keys cannot be read, and for a name that no file has and that is
// nearly a shape's or has keys behind it.
Value parse_support(std::string_view text, const std::string& where);

// A shape's name, what it is, and its keys; for help and docs.
struct ShapeHelp {
  std::string name;
  std::string help;
  std::vector<KeyHelp> keys;
};
std::vector<ShapeHelp> list_shapes();

}  // namespace talus
