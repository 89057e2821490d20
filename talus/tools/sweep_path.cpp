#include "talus/tools/sweep_path.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "talus/base/error.h"
#include "talus/field/catmull_rom.h"

namespace talus {
namespace {

constexpr double kPointsMax = 1e6;
constexpr double kTurnSine = 0.05;  // of three degrees
constexpr int kHalvingsMax = 12;    // of a step that turns more
constexpr int kStepsMin = 4;        // of a span
constexpr int kLengthSamples = 16;  // of a span
constexpr double kLeastUp = 1e-6;   // what is shorter tells no direction

// The arcs of each node, and how one goes on from one arc to another.
class ArcGraph {
 public:
  ArcGraph(std::size_t node_count, std::span<const SweepArc> arcs)
      : arcs_(arcs), at_node_(node_count), used_(arcs.size()) {
    for (std::size_t a = 0; a < arcs.size(); ++a)
      for (const int node : {arcs[a].from, arcs[a].to})
        at_node_[static_cast<std::size_t>(node)].push_back(a);
  }

  std::vector<Strand> strands() {
    std::vector<Strand> found;
    for (std::size_t a = 0; a < arcs_.size(); ++a) {
      if (used_[a]) continue;
      used_[a] = true;
      const auto from = static_cast<std::size_t>(arcs_[a].from);
      const std::vector<std::size_t> ahead = walk(a, static_cast<std::size_t>(arcs_[a].to));
      if (ahead.size() > 1 && ahead.back() == from && goes_round(a, from)) {
        found.push_back({ahead, true});
        continue;
      }
      std::vector<std::size_t> nodes = walk(a, from);
      std::reverse(nodes.begin(), nodes.end());
      nodes.insert(nodes.end(), ahead.begin(), ahead.end());
      found.push_back({std::move(nodes), false});
    }
    return found;
  }

 private:
  // The arc that continues another through a node.
  std::optional<std::size_t> next(std::size_t arc, std::size_t node) const {
    const std::vector<std::size_t>& arcs = at_node_[node];
    if (arcs.size() < 2) return {};
    if (arcs[0] == arc) return arcs[1];
    if (arcs[1] == arc) return arcs[0];
    return {};
  }
  // Whether all arcs on the way back to it from its own strand's end are used.
  bool goes_round(std::size_t arc, std::size_t node) const {
    const auto before = next(arc, node);
    return before && used_[*before];
  }

  // The nodes on the way out of an arc through one of its ends, that one first.
  std::vector<std::size_t> walk(std::size_t arc, std::size_t node) {
    std::vector<std::size_t> nodes{node};
    for (auto on = next(arc, node); on && !used_[*on]; on = next(arc, node)) {
      arc = *on;
      used_[arc] = true;
      const auto from = static_cast<std::size_t>(arcs_[arc].from);
      node = from == node ? static_cast<std::size_t>(arcs_[arc].to) : from;
      nodes.push_back(node);
    }
    return nodes;
  }

  std::span<const SweepArc> arcs_;
  std::vector<std::vector<std::size_t>> at_node_;
  std::vector<bool> used_;
};

// The curve through points; at the ends it goes on as if mirrored.
class PointCurve {
 public:
  PointCurve(std::span<const PathPoint> points, bool loop) : points_(points), loop_(loop) {}

  std::size_t spans() const { return loop_ ? points_.size() : points_.size() - 1; }
  const PathPoint& from(std::size_t span) const { return points_[span]; }
  const PathPoint& to(std::size_t span) const { return points_[(span + 1) % points_.size()]; }

  Vec3 at(std::size_t span, double t) const {
    const std::size_t n = points_.size();
    const Vec3 &p1 = from(span).at, &p2 = to(span).at;
    const Vec3 p0 = loop_ || span > 0 ? points_[(span + n - 1) % n].at : 2.0 * p1 - p2;
    const Vec3 p3 = loop_ || span + 2 < n ? points_[(span + 2) % n].at : 2.0 * p2 - p1;
    return catmull_rom(p0, p1, p2, p3, t);
  }

  // So many steps are at most `spacing` long, by and large.
  double steps(std::size_t span, double spacing) const {
    double length = 0;
    for (int k = 0; k < kLengthSamples; ++k)
      length +=
          glm::length(at(span, (k + 1.0) / kLengthSamples) - at(span, double(k) / kLengthSamples));
    return std::max(std::ceil(length / spacing), double{kStepsMin});
  }

  // Adds the end of a step, and before it what lies between as long as that turns much.
  void add_step(std::size_t span, double from, double to, int halvings,
                std::vector<PathPoint>& path) const {
    const double half = 0.5 * (from + to);
    const Vec3 end = at(span, to), middle = at(span, half);
    const Vec3 first = middle - path.back().at, second = end - middle;
    const double turn = glm::length(glm::cross(first, second));
    const bool straight = turn < kTurnSine * glm::length(first) * glm::length(second);
    if (halvings > 0 && (!straight || glm::dot(first, second) < 0)) {
      add_step(span, from, half, halvings - 1, path);
      add_step(span, half, to, halvings - 1, path);
    } else {
      path.push_back({end, glm::mix(this->from(span).up, this->to(span).up, to), 0});
    }
  }

 private:
  std::span<const PathPoint> points_;
  bool loop_;
};

// Of the parabola through three places at the middle one, which may be one of the others.
Vec3 tangent(const Vec3& before, const Vec3& here, const Vec3& after) {
  const double a = glm::length(here - before), b = glm::length(after - here);
  if (a == 0 || b == 0) return glm::normalize(after - before);
  const Vec3 sum = b / a * (here - before) + a / b * (after - here);
  return glm::normalize(sum == Vec3(0) ? after - here : sum);  // it may turn back on itself
}

}  // namespace

std::vector<Strand> find_strands(std::size_t node_count, std::span<const SweepArc> arcs) {
  return ArcGraph(node_count, arcs).strands();
}

std::vector<PathPoint> smooth_path(std::span<const PathPoint> points, bool loop, double spacing) {
  const PointCurve curve(points, loop);
  std::vector<PathPoint> path{points.front()};
  const auto check_room = [&](double more) {
    if (static_cast<double>(path.size()) + more > kPointsMax)
      throw usage_error(
          fmt::format("sweep.nodes: a path is more than a million times the {:.3g} m that its "
                      "surface is made of; shorten it",
                      spacing));
  };
  for (std::size_t span = 0; span < curve.spans(); ++span) {
    const double steps = curve.steps(span, spacing);
    check_room(steps);
    const std::size_t first = path.size();
    for (double k = 0; k < steps; ++k)
      curve.add_step(span, k / steps, (k + 1) / steps, kHalvingsMax, path);
    check_room(0);

    // Places grow with the way gone; where a loop closes, they go on growing.
    const bool closing = loop && span + 1 == curve.spans();
    const double place = curve.from(span).place;
    const double place_end = closing ? std::floor(place) + 1 : curve.to(span).place;
    std::vector<double> way{0};
    for (std::size_t i = first; i < path.size(); ++i)
      way.push_back(way.back() + glm::length(path[i].at - path[i - 1].at));
    for (std::size_t i = first; i < path.size(); ++i)
      path[i].place = std::lerp(place, place_end, way[i - first + 1] / way.back());
  }
  if (loop) path.pop_back();
  return path;
}

std::vector<Vec3> orient_path(std::span<PathPoint> path, bool loop, double roll_length) {
  const std::size_t n = path.size();
  std::vector<Vec3> along(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : loop ? n - 1 : 0;
    const std::size_t after = i + 1 < n ? i + 1 : loop ? 0 : n - 1;
    along[i] = tangent(path[before].at, path[i].at, path[after].at);

    // The direction of the point before; a path that begins straight up begins with north.
    const auto across = [&](const Vec3& v) { return v - glm::dot(v, along[i]) * along[i]; };
    const Vec3 first = std::abs(along[i].y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    Vec3 kept = across(i > 0 ? path[i - 1].up : first);
    kept = glm::normalize(glm::length(kept) > kLeastUp ? kept : across(first));
    // The more the path goes along `up`, the less that counts; half way between opposed ones there
    // is none.
    const Vec3 own = glm::length(path[i].up) > kLeastUp ? glm::normalize(path[i].up) : kept;
    const double slope = glm::dot(own, along[i]);
    path[i].up = glm::normalize(across(glm::mix(own, kept, slope * slope)));
    if (i == 0) continue;
    const double roll = glm::length(path[i].at - path[i - 1].at) / roll_length;
    if (glm::dot(path[i].up, kept) * std::sqrt(1 + roll * roll) >= 1) continue;
    const Vec3 side = glm::cross(along[i], kept);
    path[i].up = glm::normalize(kept + (glm::dot(path[i].up, side) < 0 ? -roll : roll) * side);
  }
  return along;
}

}  // namespace talus
