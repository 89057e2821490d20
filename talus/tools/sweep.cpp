#include "talus/tools/sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <set>
#include <utility>

#include "talus/base/error.h"
#include "talus/base/parallel.h"
#include "talus/field/profile_curve.h"
#include "talus/field/swept_tube.h"
#include "talus/tools/fill_mesh.h"
#include "talus/tools/roughness.h"
#include "talus/tools/surface_place.h"
#include "talus/tools/sweep_path.h"

namespace talus {
namespace {

constexpr double kFarthest = 1e6;  // metres, of a node
constexpr double kBlockColumns = 4096;
// Projected paths are put on the surface at places so many reaches of the profile apart, of a field
// whose sigma is so many reaches wide, but no more columns.
constexpr double kAnchorReaches = 0.5;
constexpr double kSigmaReaches = 0.5;
constexpr double kProjectionColumnsMax = 32;
constexpr double kRingReaches = 0.25;  // rings are at most so far apart
constexpr double kSlabShare = 0.5;     // of the roughness: half the slabs' thickness
constexpr double kVerticesMax = 1 << 24;
constexpr double kLeastReaches = 1e-3;     // points of a path are at least so far apart
constexpr double kRoughnessSizesMax = 10;  // how rough a surface can be, in sizes of its bumps
constexpr std::size_t kGrain = 1024;       // vertices of one task

std::vector<SweepArc> arcs_of(const SweepParams& params) {
  std::vector<SweepArc> arcs = params.arcs;
  const int nodes = static_cast<int>(params.nodes.size());
  if (arcs.empty())
    for (int i = 0; i + 1 < nodes; ++i) arcs.push_back({i, i + 1});
  return arcs;
}

// A node's profile in its size.
ProfileCurve curve_of(const SweepParams& params, const SweepNode& node) {
  std::vector<Vec2> points = node.profile.empty() ? params.profile : node.profile;
  for (Vec2& point : points) point *= node.scale;
  return ProfileCurve(std::move(points));
}

void check_nodes(const SweepParams& params) {
  const auto& nodes = params.nodes;
  if (nodes.size() < 2)
    throw usage_error(
        fmt::format("sweep.nodes: a path needs two nodes or more, not {}", nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SurfacePoint& at = nodes[i].at;
    if (!(std::abs(at.at.x) <= kFarthest && std::abs(at.at.y) <= kFarthest &&
          std::abs(at.z.value_or(0)) <= kFarthest))
      throw usage_error(
          fmt::format("sweep.nodes: node {} is no place; its coordinates must be numbers up to {}",
                      i, kFarthest));
    try {
      validate(nodes[i], fmt::format("sweep.nodes.{}", i));
      curve_of(params, nodes[i]);
    } catch (const Error& error) {
      throw usage_error(fmt::format("sweep: node {}: {}", i, error.what()));
    }
  }
}

void check_arcs(const SweepParams& params) {
  const int count = static_cast<int>(params.nodes.size());
  std::set<std::pair<int, int>> joined;
  std::vector<bool> used(params.nodes.size());
  for (const auto& [from, to] : arcs_of(params)) {
    const auto refuse = [from = from, to = to](std::string_view why) {
      throw usage_error(fmt::format("sweep.arcs: [{}, {}]: {}", from, to, why));
    };
    for (const int node : {from, to})
      if (node < 0 || node >= count)
        refuse(fmt::format("there is no node {}; they count from 0 to {}", node, count - 1));
    if (from == to) refuse("an arc joins two nodes");
    if (!joined.insert(std::minmax(from, to)).second) refuse("these nodes are joined already");
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    const SurfacePoint &p = params.nodes[a].at, &q = params.nodes[b].at;
    if (p.at == q.at && p.z == q.z) refuse("these nodes are at the same place");
    used[a] = used[b] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      throw usage_error(fmt::format("sweep.arcs: no arc joins node {}; leave it out", i));
}

// The nodes' outlines and what is between them.
class SweptSections {
 public:
  SweptSections(const SweepParams& params, double spacing) {
    std::vector<ProfileCurve> curves;
    for (const SweepNode& node : params.nodes) {
      curves.push_back(curve_of(params, node));
      reach_ = std::max(reach_, curves.back().reach());
    }
    outlines_ = sample_alike(curves, spacing);
  }

  double reach() const { return reach_; }
  std::size_t points() const { return outlines_.front().size(); }

  // At a place along a strand.
  std::vector<Vec2> at(const Strand& strand, double place) const {
    const std::size_t n = strand.nodes.size(), i = std::min(static_cast<std::size_t>(place), n - 1);
    const std::size_t j = i + 1 < n ? i + 1 : strand.loop ? 0 : i;
    const std::vector<Vec2>&from = outlines_[strand.nodes[i]], &to = outlines_[strand.nodes[j]];
    std::vector<Vec2> outline(from.size());
    for (std::size_t k = 0; k < outline.size(); ++k)
      outline[k] = glm::mix(from[k], to[k], place - static_cast<double>(i));
    return outline;
  }

 private:
  double reach_ = 0;
  std::vector<std::vector<Vec2>> outlines_;
};

// What the paths of a sweep have in common.
struct PathMaker {
  const LayeredTerrain& terrain;
  const SweepParams& params;
  double reach;    // of the largest profile
  double spacing;  // between the points that a rough surface is made of
  Job* job;

  // So close that pieces of the surface are at most `spacing` long.
  std::vector<PathPoint> path_along(const Strand& strand) const {
    std::vector<PathPoint> path = path_through(strand);
    if (params.projected) path = project(strand, path);
    return smooth_path(path, strand.loop, std::min(spacing, kRingReaches * reach));
  }

 private:
  // The places of a strand's nodes.
  std::vector<PathPoint> path_through(const Strand& strand) const {
    std::vector<PathPoint> path;
    for (const std::size_t node : strand.nodes) {
      const SurfacePoint& at = params.nodes[node].at;
      const double z = at.z ? *at.z : top_of_bedrock(terrain, at.at);
      path.push_back({Vec3(at.at, z), Vec3(0, 0, 1), static_cast<double>(path.size())});
    }
    for (std::size_t i = strand.loop ? 0 : 1; i < path.size(); ++i) {
      const std::size_t before = i == 0 ? path.size() - 1 : i - 1;
      if (!(glm::length(path[i].at - path[before].at) > kLeastReaches * reach))
        throw usage_error(fmt::format(
            "sweep.arcs: nodes {} and {} are at the same place, or nearly; leave one out",
            strand.nodes[before], strand.nodes[i]));
    }
    return path;
  }

  // Points of a path on the surface of the bedrock; what is very close there is one.
  std::vector<PathPoint> project(const Strand& strand, const std::vector<PathPoint>& path) const {
    const bool in_space = std::all_of(strand.nodes.begin(), strand.nodes.end(), [&](auto node) {
      return params.nodes[node].at.z.has_value();
    });
    std::vector<PathPoint> projected;
    const auto is_new = [&](const PathPoint& p, const PathPoint& other) {
      return glm::length(p.at - other.at) > kLeastReaches * reach;
    };
    for (const PathPoint& p : smooth_path(path, strand.loop, kAnchorReaches * reach)) {
      const PathPoint on = on_surface(p, in_space);
      if (projected.empty() || is_new(on, projected.back())) projected.push_back(on);
    }
    while (strand.loop && projected.size() > 1 && !is_new(projected.back(), projected.front()))
      projected.pop_back();
    if (projected.size() < (strand.loop ? 3 : 2))
      throw usage_error(fmt::format(
          "sweep.nodes: on the surface the path from node {} on is too short for a profile that "
          "reaches {:.4g} m; make it longer or the profile smaller",
          strand.nodes.front(), reach));
    return projected;
  }

  PathPoint on_surface(const PathPoint& p, bool in_space) const {
    check_cancelled(job);
    const TerrainGrid& grid = terrain.grid();
    const double sigma = half_integer_columns(
        std::min(kSigmaReaches * reach, (kProjectionColumnsMax - 1) * grid.cell), grid);
    Vec3 at = p.at;
    if (!in_space) at.z = top_of_bedrock(terrain, Vec2(at));
    const auto found = find_bedrock_surface(terrain, at, sigma);
    if (!found)
      throw usage_error(fmt::format(
          "sweep.nodes: no bedrock's surface within {:.3g} m of ({:.6g}, {:.6g}, {:.6g}), which a "
          "projected path passes",
          sigma, at.x, at.y, at.z));
    return {found->point, found->normal, p.place};
  }
};

// Throws for surfaces of too many points.
void check_count(const std::vector<std::vector<PathPoint>>& paths, std::size_t around) {
  double count = 0;
  for (const auto& path : paths)
    count += static_cast<double>(path.size()) * static_cast<double>(around);
  if (count > kVerticesMax)
    throw usage_error(fmt::format(
        "sweep: a surface of more than {} points, {} of them around each profile, is too much; "
        "choose a larger profile, a shorter path or a larger roughness_size",
        kVerticesMax, around));
}

// From where a form's points, which are floats, are counted: whole blocks of columns from the
// grid's corner, the nearest to a place.
Vec3 origin_near(const TerrainGrid& grid, const Vec3& place) {
  const double block = kBlockColumns * grid.cell;
  const auto nearest = [&](double from, double to) {
    return from + block * std::round((to - from) / block);
  };
  return {nearest(grid.origin_x, place.x), nearest(grid.origin_y, place.y), 0};
}

// The profiles of a strand on the way along its path.
std::vector<TubeRing> rings_along(const SweptSections& sections, const Strand& strand,
                                  std::vector<PathPoint> path, const Vec3& origin) {
  const std::vector<Vec3> along = orient_path(path, strand.loop, sections.reach());
  std::vector<TubeRing> rings;
  for (std::size_t i = 0; i < path.size(); ++i)
    rings.push_back(
        {path[i].at - origin, along[i], path[i].up, sections.at(strand, path[i].place)});
  return rings;
}

// Only what may reach a column of the terrain.
void roughen(TriangleMesh& mesh, const Roughness& roughness, const TerrainGrid& grid,
             const Vec3& origin, Job* job) {
  const Vec2 west_south(grid.origin_x - origin.x, grid.origin_y - origin.y);
  const Vec2 low = west_south - roughness.most();
  const Vec2 high = west_south + grid.cell * Vec2(grid.nx, grid.ny) + roughness.most();
  std::vector<char> reaches(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec2 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    if (glm::all(glm::greaterThanEqual(glm::max(a, glm::max(b, c)), low)) &&
        glm::all(glm::lessThanEqual(glm::min(a, glm::min(b, c)), high)))
      reaches[t.x] = reaches[t.y] = reaches[t.z] = true;
  }
  parallel_for(
      mesh.positions.size(),
      [&](std::size_t v) {
        if (v % kGrain == 0) check_cancelled(job);
        Vec3f& p = mesh.positions[v];
        if (reaches[v]) p = Vec3f(roughness.carried(Vec3(p) + origin) - origin);
      },
      kGrain);
}

// Throws unless the plan of the box meets that of the terrain.
void check_meets(const TerrainGrid& grid, const Box3& box) {
  const double x_end = grid.origin_x + grid.nx * grid.cell,
               y_end = grid.origin_y + grid.ny * grid.cell;
  if (box.max.x < grid.origin_x || box.max.y < grid.origin_y || box.min.x > x_end ||
      box.min.y > y_end)
    throw usage_error(fmt::format(
        "sweep.nodes: the path is outside the terrain, which reaches from ({:.6g}, {:.6g}) to "
        "({:.6g}, {:.6g})",
        grid.origin_x, grid.origin_y, x_end, y_end));
}

}  // namespace

void validate_sweep(const SweepParams& params) {
  validate(params, "sweep");
  if (params.fill.roughness > kRoughnessSizesMax * params.fill.roughness_size)
    throw usage_error(fmt::format(
        "sweep.roughness = {} m is more than {} times sweep.roughness_size = {} m; choose larger "
        "bumps or less of them",
        params.fill.roughness, kRoughnessSizesMax, params.fill.roughness_size));
  check_nodes(params);
  check_arcs(params);
}

void check_within_reach(const TerrainGrid& grid, const SweepParams& params) {
  Box3 box;
  double reach = 0;
  for (const SweepNode& node : params.nodes) {
    box.include(Vec3(node.at.at, 0));
    for (const Vec2& point : node.profile.empty() ? params.profile : node.profile)
      reach = std::max(reach, node.scale * glm::length(point));
  }
  // A curve swings out from the points that it goes through by less than they are apart.
  const double swing = glm::length(box.size()) + 2 * reach + params.fill.roughness;
  box.include(box.min - swing);
  box.include(box.max + swing);
  check_meets(grid, box);
}

Booking sweep(LayeredTerrain& terrain, const SweepParams& params, std::uint64_t seed, Job* job) {
  validate_sweep(params);
  const Roughness roughness(params.fill.roughness, params.fill.roughness_size, seed);
  double spacing = std::numeric_limits<double>::infinity();
  if (params.fill.roughness > 0)
    spacing = 0.5 * std::max(roughness.finest_bump(), terrain.grid().cell);

  const SweptSections sections(params, spacing);
  const std::vector<Strand> strands = find_strands(params.nodes.size(), arcs_of(params));
  const PathMaker maker{terrain, params, sections.reach(), spacing, job};
  std::vector<std::vector<PathPoint>> paths;
  for (const Strand& strand : strands) {
    paths.push_back(maker.path_along(strand));
    check_count(paths, sections.points());
  }

  const Vec3 origin = origin_near(terrain.grid(), paths.front().front().at);
  std::vector<TriangleMesh> solids;  // closed, may overlap
  for (std::size_t i = 0; i < strands.size(); ++i) {
    check_cancelled(job);
    const auto rings = rings_along(sections, strands[i], paths[i], origin);
    solids.push_back(swept_tube(rings, strands[i].loop));
    if (params.fill.roughness == 0) continue;
    const double half_thickness = kSlabShare * params.fill.roughness;
    for (TriangleMesh& slab : slabs_in_bends(rings, strands[i].loop, half_thickness))
      solids.push_back(std::move(slab));
  }
  if (params.fill.roughness > 0)
    for (TriangleMesh& solid : solids) roughen(solid, roughness, terrain.grid(), origin, job);
  Box3 box;
  for (const TriangleMesh& solid : solids) box.include(bounds(solid));
  check_meets(terrain.grid(), {box.min + origin, box.max + origin});

  const FillMeshParams fill{params.fill.material, params.fill.replaces, Vec2(origin)};
  LayeredTerrain changed = terrain;
  Booking booking;
  for (const TriangleMesh& solid : solids) booking.add(fill_mesh(changed, solid, fill, job));
  terrain = std::move(changed);
  return booking;
}

}  // namespace talus
