// Pictures of what a pile is like inside.
#pragma once

#include <span>
#include <vector>

#include "talus/base/image.h"
#include "talus/piles/pile.h"

namespace talus {

// A level cut through a part of space, seen from above: x to the right, y upward.
struct Section {
  double height = 0;  // z of the cut, m
  Vec2 min{0};        // of the part that is drawn, m
  Vec2 max{1};
  int width = 1024;  // of the picture, pixels; its height follows
};

constexpr int kSectionMaxRows = 8192;

// Draws each solid that the section cuts in a color of its own, the gaps between dark, and a red
// dot of radius `mark_radius` metres at each of the `marks`. Meshes must be closed; where solids
// overlap the later one shows. RGB. Throws `Error` (usage) for a part without extent, or one that
// is more than `kSectionMaxRows` pixels high.
Image draw_section(const InstanceTable& solids, const Section& section,
                   std::span<const Vec2> marks = {}, double mark_radius = 0);

// Where a pile's stones touch, as far as they know by themselves, within half a voxel of a height.
std::vector<Vec2> contacts_near(const Pile& pile, double height);

}  // namespace talus
