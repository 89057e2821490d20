// Shapes that repeat: the raked gravel of a garden, the courses of a wall, a spiral.
#pragma once

#include <vector>

#include "talus/base/describe.h"
#include "talus/base/vec.h"
#include "talus/field/shape_fields.h"

namespace talus {

// A bed of gravel raked in straight rows, and in rings around what stands in it.
struct Raked {
  Vec3 center{0};
  Vec2 size{6, 4};
  double thickness = 0.1;
  double ridge = 0.06;
  double spacing = 0.3;
  double direction_deg = 0;
  std::vector<Vec3> rings;
  static constexpr std::string_view kName = "raked";
  static constexpr std::string_view kHelp =
      "a bed of gravel with the furrows of a rake: straight rows, and rings that the rows give way "
      "to";
  static void describe(auto& p, auto&& field) {
    field(p.center, place_field("center", "middle of the lower side"));
    field(p.size, extent_field("size", "edge lengths along x and y"));
    field(p.thickness, extent_field("thickness", "of the bed below the furrows"));
    field(p.ridge, extent_field("ridge", "height of the ridges above the furrows"));
    field(p.spacing, extent_field("spacing", "from one furrow to the next"));
    field(p.direction_deg, Field{.name = "direction_deg",
                                 .help = "where the rows run, counter-clockwise from the x axis",
                                 .unit = "degrees",
                                 .min = -360,
                                 .max = 360});
    field(p.rings, place_field("rings", "[x, y, radius] of each place that rings surround"));
  }
};

// Layers without end, one upon the other, to be cut to the form of a wall.
struct Courses {
  double base = 0;
  double height = 0.25;
  double joint = 0.02;
  static constexpr std::string_view kName = "courses";
  static constexpr std::string_view kHelp =
      "level layers with joints between them, without end: intersect them with a wall";
  static void describe(auto& p, auto&& field) {
    field(p.base, place_field("base", "z where a layer begins"));
    field(p.height, extent_field("height", "from one layer's beginning to the next"));
    field(p.joint, Field{.name = "joint",
                         .help = "what is left empty above each layer, less than `height`",
                         .unit = "m",
                         .min = 0,
                         .max = 1e9});
  }
};

// A wall that winds outward, counter-clockwise seen from above, as far from turn to turn.
struct Spiral {
  Vec3 base{0};
  double inner_radius = 0.5;
  double outer_radius = 3;
  double pitch = 1;
  double width = 0.5;
  double height = 0.5;
  static constexpr std::string_view kName = "spiral";
  static constexpr std::string_view kHelp = "a wall that winds outward around an upright axis";
  static void describe(auto& p, auto&& field) {
    field(p.base, place_field("base", "where the axis meets the lower side"));
    field(p.inner_radius, extent_field("inner_radius", "where the wall begins, east of the axis"));
    field(p.outer_radius, extent_field("outer_radius", "where it ends, at least `inner_radius`"));
    field(p.pitch, extent_field("pitch", "from one turn to the next"));
    field(p.width, extent_field("width", "of the wall, less than `pitch`"));
    field(p.height, extent_field("height", "of the wall"));
  }
};

}  // namespace talus
