// Forms that a cross section makes on its way along branching paths.
#pragma once

#include <cstdint>
#include <vector>

#include "talus/base/describe.h"
#include "talus/base/job.h"
#include "talus/terrain/layered_terrain.h"
#include "talus/tools/fill_support.h"
#include "talus/tools/stroke.h"

namespace talus {

// A place that paths go through, and the cross section there.
struct SweepNode {
  SurfacePoint at;
  double scale = 1;
  std::vector<Vec2> profile;  // of none: the sweep's

  static void describe(auto& p, auto&& field) {
    field(p.at, Field{.name = "at", .help = "place; without z, on the topmost bedrock"});
    field(
        p.scale,
        Field{
            .name = "scale", .help = "what the profile is multiplied by", .min = 1e-6, .max = 1e6});
    field(p.profile,
          Field{.name = "profile", .help = "cross section here, instead of the sweep's"});
  }
};

// From one node to another, by their places in the list.
struct SweepArc {
  int from = 0;
  int to = 0;
};

struct SweepParams {
  std::vector<Vec2> profile;
  std::vector<SweepNode> nodes;
  std::vector<SweepArc> arcs;  // of none: from each node to the next
  bool projected = false;
  FillParams fill;

  static void describe(auto& p, auto&& field) {
    field(p.profile,
          Field{.name = "profile",
                .help = "cross section: points [across, up] around it, three or more, across "
                        "to the right of the path; a smooth closed curve goes through them",
                .unit = "m"});
    field(
        p.nodes,
        Field{.name = "nodes",
              .help =
                  "where paths go; a place without z is on the topmost bedrock. `scale` "
                  "multiplies the profile there, `profile` replaces it; begin profiles at the same "
                  "side, their points are joined in order",
              .unit = "m"});
    field(p.arcs, Field{.name = "arcs",
                        .help = "which nodes, counted from 0, paths join; by default each to the "
                                "next. The first two arcs of a node go smoothly through it, "
                                "others branch off"});
    field(p.projected,
          Field{.name = "projected",
                .help = "whether paths follow the bedrock's surface, the profile turned to its "
                        "normal: cracks, gorges, cliffs. Otherwise they go through space, the "
                        "profile upright: tunnels, bridges"});
    FillParams::describe(p.fill, field);
  }
};

// Throws `Error` (usage) for params out of range; fewer than two nodes, two joined ones at the same
// place, one that no arc joins; an arc from a node to itself or to one that is not there; a
// `ProfileCurve` that cannot be made.
void validate_sweep(const SweepParams& params);

// Throws `Error` (usage) if every node is so far from the terrain that no profile can reach it,
// however the path swings between them.
void check_within_reach(const TerrainGrid& grid, const SweepParams& params);

// Fills with a material what profiles pass through on their way along paths ([Peytavie2009a]
// section 4.2): air carves, min(f, -f*), bedrock adds, max(f, f*), as far as the materials may be
// replaced. Columns end where their axis crosses the swept solid's surface, to the step, or to a
// ten-millionth of their distance from the first node if that is more.
//
// Paths are centripetal Catmull-Rom curves through the nodes, and end level with their last
// profile. Between two nodes points of the profiles with equal share of the curve move on straight
// lines in proportion to the way gone. Where arcs branch off or meet, all that any of them passes
// through is filled. A profile stands upright across its path, in a steep shaft as it came; of
// projected paths it stands on the bedrock's surface, smoothed over half the profile's reach (at
// most 32 columns). With roughness, the solid's surface is carried along by noise, at most as far
// as it says, without folding over itself; its points are at least half a column apart, so that
// smaller bumps are not told apart.
//
// Throws `Error` (usage) as `validate_sweep`; if the solid lies wholly beside the terrain, a
// projected path finds no surface, or the solid's own has more than 2^24 points.
Booking sweep(LayeredTerrain& terrain, const SweepParams& params, std::uint64_t seed,
              Job* job = nullptr);

}  // namespace talus
