// The generalised winding number of a triangle soup.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "talus/base/vec.h"

namespace talus {

// How often a soup of oriented triangles winds around a point [Jacobson2013]: 1 inside a closed
// outward mesh, 0 outside, in between near holes. Triangles that are far from the point for their
// size are summed as one dipole [Barill2018], which errs by less than 0.02.
class WindingNumber {
 public:
  explicit WindingNumber(std::span<const std::array<Vec3, 3>> triangles);

  double at(const Vec3& p) const;

 private:
  // Children of an inner node are the nodes `first` and `first` + 1; a leaf has `count` triangles
  // from `first` on.
  struct Node {
    Vec3 center;        // area-weighted middle
    Vec3 area_normal;   // sum of half cross products
    double radius = 0;  // of a ball around `center` that holds the triangles
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  void summarize(Node& node, std::uint32_t begin, std::uint32_t end) const;

  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace talus
