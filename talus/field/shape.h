// Smooth primitives and their combinations, as signed distances.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "talus/base/describe.h"
#include "talus/field/patterns.h"
#include "talus/field/shape_fields.h"
#include "talus/field/support.h"

namespace talus {

struct Sphere {
  Vec3 center{0};
  double radius = 1;
  static constexpr std::string_view kName = "sphere";
  static constexpr std::string_view kHelp = "all points within a radius of a center";
  static void describe(auto& p, auto&& field) {
    field(p.center, place_field("center", "middle of the sphere"));
    field(p.radius, extent_field("radius", "distance to the surface"));
  }
};

struct Box {
  Vec3 center{0};
  Vec3 size{1};
  double rounding = 0;
  static constexpr std::string_view kName = "box";
  static constexpr std::string_view kHelp = "an axis-aligned box, its edges rounded on demand";
  static void describe(auto& p, auto&& field) {
    field(p.center, place_field("center", "middle of the box"));
    field(p.size, extent_field("size", "edge lengths along x, y and z"));
    field(p.rounding, Field{.name = "rounding",
                            .help = "radius of the edges, at most half the shortest edge",
                            .unit = "m",
                            .min = 0,
                            .max = 1e9});
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
    field(p.from, place_field("from", "center of the first sphere"));
    field(p.to, place_field("to", "center of the second sphere"));
    field(p.from_radius, extent_field("from_radius", "radius of the first sphere"));
    field(p.to_radius, extent_field("to_radius", "radius of the second sphere"));
  }
};

struct Cylinder {
  Vec3 base{0};
  double radius = 0.5;
  double height = 1;
  static constexpr std::string_view kName = "cylinder";
  static constexpr std::string_view kHelp = "an upright cylinder";
  static void describe(auto& p, auto&& field) {
    field(p.base, place_field("base", "middle of the lower end"));
    field(p.radius, extent_field("radius", "distance from the axis to the side"));
    field(p.height, extent_field("height", "length along z"));
  }
};

struct HalfSpace {
  Vec3 point{0};
  Vec3 normal{0, 0, 1};
  static constexpr std::string_view kName = "half_space";
  static constexpr std::string_view kHelp = "everything on one side of a plane, without end";
  static void describe(auto& p, auto&& field) {
    field(p.point, place_field("point", "a point of the plane"));
    field(p.normal, Field{.name = "normal",
                          .help = "points away from what is filled; its length does not matter",
                          .min = -1e9,
                          .max = 1e9});
  }
};

struct Combination;
using Shape =
    std::variant<Sphere, Box, Capsule, Cylinder, HalfSpace, Raked, Courses, Spiral, Combination>;

// The first part joined with, cut by or reduced to the others, in order.
struct Combination {
  enum class Rule { join, subtract, intersect };
  Rule rule = Rule::join;
  double blend = 0;  // metres over which neighbouring surfaces flow into each other
  std::vector<Shape> parts;
};

using BlockDistances = std::array<double, kBlockPoints>;

// Signed distance of a point to a shape's surface, negative inside: never larger in magnitude than
// the true distance, so that a ball of that radius is free of surface, and nowhere steeper than 1.
class DistanceFunction {
 public:
  class Implementation;
  explicit DistanceFunction(std::shared_ptr<const Implementation> implementation)
      : implementation_(std::move(implementation)) {}

  double operator()(const Vec3& p) const;
  // The same for all points of a block, to the bit.
  void operator()(const PointBlock& block, BlockDistances& distances) const;

 private:
  std::shared_ptr<const Implementation> implementation_;
};

// What depends on the shape alone is computed once.
DistanceFunction distance_function(const Shape& shape);
Box3 bounds(const Shape& shape);

class ShapeSupport final : public Support {
 public:
  // Throws `Error` (usage) for a value out of range or a combination without parts.
  explicit ShapeSupport(const Shape& shape);

  bool contains(const Vec3& p) const override { return distance_(p) <= 0; }
  BoxState classify(const Box3& box) const override;
  std::uint64_t contains_block(const PointBlock& block) const override;
  BlockStates classify_block(const PointBlock& centers, const Vec3& half) const override;
  std::optional<Clearance> clearance(const Vec3& p) const override {
    const double distance = distance_(p);
    return Clearance{distance <= 0, std::abs(distance)};
  }
  Box3 bounds() const override { return bounds_; }

 private:
  DistanceFunction distance_;
  Box3 bounds_;
};

}  // namespace talus
