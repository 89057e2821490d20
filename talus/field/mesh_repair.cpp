#include "talus/field/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include "talus/mesh/check.h"

namespace talus {
namespace {

struct HalfEdge {
  std::uint32_t low, high, triangle;
  bool forward;
};

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

void join_and_drop(const TriangleMesh& mesh, RepairedMesh& out) {
  const std::vector<std::uint32_t> joined = joined_vertices(mesh);
  std::vector<std::uint32_t> number(joined.size());
  for (std::uint32_t i = 0; i < joined.size(); ++i)
    if (joined[i] == i) {
      number[i] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.emplace_back(mesh.positions[i]);
    }
  for (const Triangle& t : mesh.triangles) {
    const Corners c = {number[joined[t.x]], number[joined[t.y]], number[joined[t.z]]};
    const Vec3 a = out.vertices[c[0]], b = out.vertices[c[1]], d = out.vertices[c[2]];
    if (glm::cross(b - a, d - a) == Vec3(0))
      ++out.report.degenerate;
    else
      out.triangles.push_back(c);
  }
  // Of triangles with the same corners the first stays.
  const auto sorted = [](Corners c) {
    std::sort(c.begin(), c.end());
    return c;
  };
  std::vector<std::pair<Corners, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < out.triangles.size(); ++i)
    order.emplace_back(sorted(out.triangles[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<bool> repeated(out.triangles.size());
  for (std::size_t i = 1; i < order.size(); ++i)
    repeated[order[i].second] = order[i].first == order[i - 1].first;
  std::vector<Corners> kept;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    if (repeated[i])
      ++out.report.duplicates;
    else
      kept.push_back(out.triangles[i]);
  }
  out.triangles = std::move(kept);
}

std::vector<HalfEdge> sorted_edges(const RepairedMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.triangles[t][c], b = mesh.triangles[t][(c + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

// Calls `use(first, last)` for the run of half edges on each edge.
void for_each_edge(const std::vector<HalfEdge>& edges, auto&& use) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high)
      ++end;
    use(i, end);
    i = end;
  }
}

// Walks each patch of triangles connected by two-sided edges and turns the minority.
void orient_patches(RepairedMesh& mesh) {
  struct Link {
    std::uint32_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Link>> links(mesh.triangles.size());
  const std::vector<HalfEdge> edges = sorted_edges(mesh);
  for_each_edge(edges, [&](std::size_t first, std::size_t last) {
    if (last - first != 2) return;
    const HalfEdge &a = edges[first], &b = edges[first + 1];
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
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++mesh.report.flipped;
      }
  }
}

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Counts open and crowded edges and closes the unbalanced ones with fans. The unbalanced edges of a
// connected rim form closed chains, so a fan around any one point closes them all.
void cap_holes(RepairedMesh& mesh) {
  struct RimEdge {
    std::uint32_t from, to;
  };
  std::vector<RimEdge> rim;
  const std::vector<HalfEdge> edges = sorted_edges(mesh);
  for_each_edge(edges, [&](std::size_t first, std::size_t last) {
    mesh.report.boundary_edges += last - first == 1;
    mesh.report.non_manifold_edges += last - first > 2;
    int balance = 0;
    for (std::size_t i = first; i < last; ++i) balance += edges[i].forward ? 1 : -1;
    const RimEdge back{edges[first].high, edges[first].low};
    const RimEdge forth{back.to, back.from};
    rim.insert(rim.end(), static_cast<std::size_t>(std::abs(balance)), balance > 0 ? back : forth);
  });

  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const RimEdge& e : rim) parent[root(parent, e.from)] = root(parent, e.to);
  std::vector<Vec3> sum(mesh.vertices.size(), Vec3(0));
  std::vector<std::uint32_t> count(mesh.vertices.size(), 0), apex(mesh.vertices.size(), 0);
  for (const RimEdge& e : rim) {
    sum[root(parent, e.from)] += mesh.vertices[e.from];
    ++count[root(parent, e.from)];
  }
  for (const RimEdge& e : rim) {
    const std::uint32_t r = root(parent, e.from);
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
  for (const Corners& t : mesh.triangles)
    six_volumes += glm::dot(mesh.vertices[t[0]] - origin,
                            glm::cross(mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin));
  mesh.report.inverted = six_volumes < 0;
  if (mesh.report.inverted)
    for (Corners& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace

RepairedMesh repair(const TriangleMesh& mesh) {
  check_input(mesh);
  RepairedMesh out;
  out.report.triangles = mesh.triangles.size();
  join_and_drop(mesh, out);
  orient_patches(out);
  face_outward(out);
  cap_holes(out);
  return out;
}

}  // namespace talus
