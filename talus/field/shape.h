// Smooth primitives and their combinations, as signed distances.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "talus/base/describe.h"
#include "talus/field/support.h"

namespace talus {

struct Sphere {
  Vec3 center{0};
  double radius = 1;
  static constexpr std::string_view kName = "sphere";
  static constexpr std::string_view kHelp = "all points within a radius of a center";
  static void describe(auto& p, auto&& field) {
    field(p.center, Field{.name = "center", .help = "middle of the sphere", .unit = "m"});
    field(p.radius,
          Field{.name = "radius", .help = "distance to the surface", .unit = "m", .min = 1e-6});
  }
};

struct Box {
  Vec3 center{0};
  Vec3 size{1};
  double rounding = 0;
  static constexpr std::string_view kName = "box";
  static constexpr std::string_view kHelp = "an axis-aligned box, its edges rounded on demand";
  static void describe(auto& p, auto&& field) {
    field(p.center, Field{.name = "center", .help = "middle of the box", .unit = "m"});
    field(p.size,
          Field{.name = "size", .help = "edge lengths along x, y and z", .unit = "m", .min = 1e-6});
    field(p.rounding, Field{.name = "rounding",
                            .help = "radius of the edges, at most half the shortest edge",
                            .unit = "m",
                            .min = 0});
  }
};

struct Capsule {
  Vec3 from{0};
  Vec3 to{0, 0, 1};
  double from_radius = 0.25;
  double to_radius = 0.25;
  static constexpr std::string_view kName = "capsule";
  static constexpr std::string_view kHelp = "the hull of two spheres; the radii may differ";
  static void describe(auto& p, auto&& field) {
    field(p.from, Field{.name = "from", .help = "center of the first sphere", .unit = "m"});
    field(p.to, Field{.name = "to", .help = "center of the second sphere", .unit = "m"});
    field(
        p.from_radius,
        Field{
            .name = "from_radius", .help = "radius of the first sphere", .unit = "m", .min = 1e-6});
    field(
        p.to_radius,
        Field{
            .name = "to_radius", .help = "radius of the second sphere", .unit = "m", .min = 1e-6});
  }
};

struct Cylinder {
  Vec3 base{0};
  double radius = 0.5;
  double height = 1;
  static constexpr std::string_view kName = "cylinder";
  static constexpr std::string_view kHelp = "an upright cylinder";
  static void describe(auto& p, auto&& field) {
    field(p.base, Field{.name = "base", .help = "middle of the lower end", .unit = "m"});
    field(p.radius, Field{.name = "radius",
                          .help = "distance from the axis to the side",
                          .unit = "m",
                          .min = 1e-6});
    field(p.height, Field{.name = "height", .help = "length along z", .unit = "m", .min = 1e-6});
  }
};

struct Combination;
using Shape = std::variant<Sphere, Box, Capsule, Cylinder, Combination>;

// The first part joined with, cut by or reduced to the others, in order.
struct Combination {
  enum class Rule { join, subtract, intersect };
  Rule rule = Rule::join;
  double blend = 0;  // metres over which neighbouring surfaces flow into each other
  std::vector<Shape> parts;
};

// Signed distance to the shape's surface, negative inside: never larger in magnitude than the true
// distance, so that a ball of that radius is free of surface.
double signed_distance(const Shape& shape, const Vec3& p);
Box3 bounds(const Shape& shape);

class ShapeSupport final : public Support {
 public:
  // Throws `Error` (usage) for a value out of range or a combination without parts.
  explicit ShapeSupport(Shape shape);

  bool contains(const Vec3& p) const override { return signed_distance(shape_, p) <= 0; }
  BoxState classify(const Box3& box) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  Shape shape_;
  Box3 bounds_;
};

}  // namespace talus
