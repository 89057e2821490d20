#include "talus/field/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>

#include "talus/base/union_find.h"
#include "talus/mesh/check.h"
#include "talus/mesh/half_edges.h"

namespace talus {
namespace {

void check_input(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw input_error("the mesh has no triangles");
  for (const Vec3f& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw input_error("the mesh has a vertex whose coordinates are not finite");
  for (const Triangle& t : mesh.triangles)
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size())
      throw input_error(fmt::format("the mesh has a triangle with vertex {}, but only {} vertices",
                                    std::max({t.x, t.y, t.z}), mesh.positions.size()));
}

// Triangles over vertices at distinct positions, without those that have no area.
void join(const TriangleMesh& mesh, RepairedMesh& out) {
  const std::vector<std::uint32_t> joined = joined_vertices(mesh);
  std::vector<std::uint32_t> number(joined.size());
  for (std::uint32_t i = 0; i < joined.size(); ++i)
    if (joined[i] == i) {
      number[i] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.emplace_back(mesh.positions[i]);
    }
  for (const Triangle& t : mesh.triangles) {
    const Triangle c(number[joined[t.x]], number[joined[t.y]], number[joined[t.z]]);
    const Vec3 a = out.vertices[c.x], b = out.vertices[c.y], d = out.vertices[c.z];
    if (glm::cross(b - a, d - a) == Vec3(0))
      ++out.report.degenerate;
    else
      out.triangles.push_back(c);
  }
}

// The corners of a triangle in increasing order, and whether that order runs the same way around.
struct SortedCorners {
  std::array<std::uint32_t, 3> corners;
  bool even;
};
SortedCorners sorted_corners(const Triangle& t) {
  const bool even = (t.x < t.y) + (t.y < t.z) + (t.z < t.x) == 2;
  SortedCorners sorted{{t.x, t.y, t.z}, even};
  std::sort(sorted.corners.begin(), sorted.corners.end());
  return sorted;
}

// For every triangle the first one with the same corners.
std::vector<std::uint32_t> first_of_equals(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    order.emplace_back(sorted_corners(triangles[i]).corners, i);
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> first(triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i].second] = i > 0 && order[i].first == order[i - 1].first
                                 ? first[order[i - 1].second]
                                 : order[i].second;
  return first;
}

// Of triangles with the same corners one stays. Two that face each other across no distance are the
// inner wall between two solids, and both go, if their sheet ends at other triangles; a sheet that
// does not is a surface drawn from both sides, of which one side stays.
void drop_duplicates(RepairedMesh& mesh) {
  const std::vector<std::uint32_t> first = first_of_equals(mesh.triangles);
  std::vector<bool> faced(mesh.triangles.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    if (sorted_corners(mesh.triangles[i]).even != sorted_corners(mesh.triangles[first[i]]).even)
      faced[first[i]] = true;

  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  UnionFind sheets(count);
  std::vector<bool> ends_at_others(count);
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
  const auto for_each_faced_edge = [&](auto&& use) {
    for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
      for (const HalfEdge& side : edge)
        if (faced[first[side.triangle]]) use(edge, first[side.triangle]);
    });
  };
  for_each_faced_edge([&](std::span<const HalfEdge> edge, std::uint32_t triangle) {
    for (const HalfEdge& other : edge)
      if (faced[first[other.triangle]]) sheets.join(triangle, first[other.triangle]);
  });
  for_each_faced_edge([&](std::span<const HalfEdge> edge, std::uint32_t triangle) {
    for (const HalfEdge& other : edge)
      if (!faced[first[other.triangle]]) ends_at_others[sheets.root(triangle)] = true;
  });

  std::vector<Triangle> kept;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first[i] == i && !(faced[i] && ends_at_others[sheets.root(i)]))
      kept.push_back(mesh.triangles[i]);
    else
      ++mesh.report.duplicates;
  }
  mesh.triangles = std::move(kept);
}

// Walks each patch of triangles connected by two-sided edges and turns the minority.
void orient_patches(RepairedMesh& mesh) {
  struct Link {
    std::uint32_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Link>> links(mesh.triangles.size());
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
  for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    const HalfEdge &a = edge[0], &b = edge[1];
    links[a.triangle].push_back({b.triangle, a.forward != b.forward});
    links[b.triangle].push_back({a.triangle, a.forward != b.forward});
  });

  enum class Mark : std::uint8_t { unseen, keep, turn };
  std::vector<Mark> marks(mesh.triangles.size(), Mark::unseen);
  std::vector<std::uint32_t> patch;
  for (std::uint32_t start = 0; start < marks.size(); ++start) {
    if (marks[start] != Mark::unseen) continue;
    marks[start] = Mark::keep;
    patch.assign(1, start);
    std::size_t turned = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      turned += marks[patch[i]] == Mark::turn;
      for (const Link& link : links[patch[i]]) {
        if (marks[link.triangle] != Mark::unseen) continue;
        const bool keep = (marks[patch[i]] == Mark::keep) == link.agrees;
        marks[link.triangle] = keep ? Mark::keep : Mark::turn;
        patch.push_back(link.triangle);
      }
    }
    const Mark minority = 2 * turned > patch.size() ? Mark::keep : Mark::turn;
    for (const std::uint32_t t : patch)
      if (marks[t] == minority) {
        std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
        ++mesh.report.flipped;
      }
  }
}

// Counts open and crowded edges and closes the unbalanced ones with fans. The unbalanced edges of a
// connected rim form closed chains, so a fan around any one point closes them all.
void cap_holes(RepairedMesh& mesh) {
  struct RimEdge {
    std::uint32_t from, to;
  };
  std::vector<RimEdge> rim;
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
  for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
    mesh.report.boundary_edges += edge.size() == 1;
    mesh.report.non_manifold_edges += edge.size() > 2;
    int balance = 0;
    for (const HalfEdge& side : edge) balance += side.forward ? 1 : -1;
    const RimEdge back{edge[0].high, edge[0].low};
    const RimEdge forth{back.to, back.from};
    rim.insert(rim.end(), static_cast<std::size_t>(std::abs(balance)), balance > 0 ? back : forth);
  });

  UnionFind rims(mesh.vertices.size());
  for (const RimEdge& e : rim) rims.join(e.from, e.to);
  std::vector<Vec3> sum(mesh.vertices.size(), Vec3(0));
  std::vector<std::uint32_t> count(mesh.vertices.size(), 0), apex(mesh.vertices.size(), 0);
  for (const RimEdge& e : rim) {
    sum[rims.root(e.from)] += mesh.vertices[e.from];
    ++count[rims.root(e.from)];
  }
  for (const RimEdge& e : rim) {
    const std::uint32_t r = rims.root(e.from);
    if (apex[r] == 0) {
      apex[r] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(sum[r] / static_cast<double>(count[r]));
    }
    mesh.caps.push_back({e.from, e.to, apex[r]});
  }
}

void face_outward(RepairedMesh& mesh) {
  Box3 box;
  for (const Vec3& p : mesh.vertices) box.include(p);
  const Vec3 origin = box.center();
  double six_volumes = 0;
  for (const Triangle& t : mesh.triangles)
    six_volumes += glm::dot(mesh.vertices[t.x] - origin,
                            glm::cross(mesh.vertices[t.y] - origin, mesh.vertices[t.z] - origin));
  mesh.report.volume = std::abs(six_volumes) / 6;
  mesh.report.inverted = six_volumes < 0;
  if (mesh.report.inverted)
    for (Triangle& t : mesh.triangles) std::swap(t.y, t.z);
}

}  // namespace

RepairedMesh repair(const TriangleMesh& mesh) {
  check_input(mesh);
  RepairedMesh out;
  out.report.triangles = mesh.triangles.size();
  join(mesh, out);
  drop_duplicates(out);
  orient_patches(out);
  face_outward(out);
  cap_holes(out);
  return out;
}

}  // namespace talus
