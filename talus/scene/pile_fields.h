// How the choices of pile parameters are written in recipes.
#pragma once

#include <string>

#include "talus/piles/pile_control.h"
#include "talus/piles/pile_params.h"
#include "talus/scene/fields.h"
#include "talus/scene/support_source.h"

namespace talus {

template <>
inline constexpr auto kEnumNames<Membership> = std::to_array<EnumName<Membership>>(
    {{Membership::anchors, "anchors"}, {Membership::center, "center"}});

// A stone as the instance table names it: [x, y, z] of its cell, or [x, y, z, seed].
void read_value(const Value& value, const std::string& path, StoneId& out);
Value write_value(const StoneId& stone);
std::string type_name(const StoneId&);

struct MovedStoneSource {
  StoneId stone;
  Vec3 by{0};
  Vec3 rotate_deg{0};

  static void describe(auto& p, auto&& field) {
    field(p.stone, Field{.name = "stone", .help = "which stone of the tiling"});
    field(p.by, Field{.name = "by", .help = "how far it is moved", .unit = "m"});
    field(p.rotate_deg,
          Field{.name = "rotate_deg",
                .help = "turns about its pivot and the x, y and z axes, in this order",
                .unit = "degrees",
                .min = -360,
                .max = 360});
  }
};
inline std::string type_name(const MovedStoneSource&) {
  return "{ stone = [x, y, z], by = [x, y, z] }";
}

// Control of a pile, as a recipe says it.
struct PileControlSource {
  std::vector<PileSource> keep_out;
  std::vector<std::string> keep_out_piles;
  std::optional<std::filesystem::path> density_mask;
  std::vector<StoneId> removed;
  std::vector<StoneId> locked;
  std::vector<MovedStoneSource> moved;

  static void describe(auto& p, auto&& field) {
    field(p.keep_out, Field{.name = "keep_out",
                            .help = "supports that stones do not reach into, with any anchor"});
    field(
        p.keep_out_piles,
        Field{
            .name = "keep_out_piles",
            .help =
                "names of earlier piles that stones do not reach into, so that gravel lies "
                "between boulders; give stones half as large at most; moved stones do not count"});
    field(p.density_mask,
          Field{.name = "density_mask",
                .help = "picture over the terrain, a pixel for each column, or over the support's "
                        "plan: black keeps no stone, white those that density keeps"});
    field(p.removed, Field{.name = "removed", .help = "stones taken away by hand"});
    field(p.locked, Field{.name = "locked", .help = "stones that stay, whatever the support is"});
    field(p.moved, Field{.name = "moved", .help = "stones put elsewhere by hand"});
  }
};

}  // namespace talus
