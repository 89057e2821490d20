// Paths through the nodes of a sweep.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "talus/tools/sweep.h"

namespace talus {

// Nodes that one smooth path goes through, by their places in the list.
struct Strand {
  std::vector<std::size_t> nodes;
  bool loop = false;  // from the last node on to the first
};

// Every arc is part of one strand. The first two arcs of a node continue each other.
std::vector<Strand> find_strands(std::size_t node_count, std::span<const SweepArc> arcs);

// A place on a path, and how far it is along the strand: 1.25 is a quarter of the way from its
// second node to its third.
struct PathPoint {
  Vec3 at{0};
  Vec3 up{0, 0, 1};
  double place = 0;
};

// Points on the smooth curve through others, those among them: at most about `spacing` apart, and
// so close together that each turns only a few degrees from the one before. Throws `Error` (usage)
// for more than a million.
std::vector<PathPoint> smooth_path(std::span<const PathPoint> points, bool loop, double spacing);

// Unit vectors along a path. Sets each point's `up` at right angles to it: as it was, or, where the
// path goes along that, as at the point before. It turns about the path by at most a radian in
// `roll_length`, so that a path which comes out of a shaft the other way round rights itself.
std::vector<Vec3> orient_path(std::span<PathPoint> path, bool loop, double roll_length);

}  // namespace talus
