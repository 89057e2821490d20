#include "talus/rocks/block_statistics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "talus/base/parallel.h"

namespace talus::rocks {
namespace {

// The least squared distance between seeds of a block, of one cell or of two next to each other.
float least_distance2(const Block& block, int voxels_per_cell) {
  float least = std::numeric_limits<float>::infinity();
  for (const Candidate& a : block.candidates)
    for (int i = 13; i < 27; ++i) {  // the cell's own and half of those around it
      const Int3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const Vec3f from = a.form->position - Vec3f(voxels_per_cell * step);
      for (const Candidate& b : block.candidates_of(a.cell + step)) {
        const Vec3f d = b.form->position - from;
        if (&a != &b) least = std::min(least, glm::dot(d, d));
      }
    }
  return least;
}

}  // namespace

double least_seed_spacing(const BlockTable& table) {
  const std::span<const Block> blocks = table.blocks();
  const int voxels = table.layout().voxels_per_cell;
  std::vector<float> least(blocks.size());
  parallel_for(blocks.size(),
               [&](std::size_t i) { least[i] = least_distance2(blocks[i], voxels); });
  return std::sqrt(double{*std::min_element(least.begin(), least.end())}) / voxels;
}

}  // namespace talus::rocks
