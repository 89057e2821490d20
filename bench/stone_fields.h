// Fields of solids about as large and as round as stones, for all who turn them into meshes.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "talus/base/hash.h"
#include "talus/base/vec.h"

namespace talus::bench {

// Samples of a body with `kFaces` rounded faces on a cube of `side` samples, positive inside and in
// [-1, 1], of the kind that `polygonize` takes.
inline std::vector<float> stone_field(int side, std::uint64_t seed) {
  constexpr int kFaces = 14;
  struct Face {
    Vec3 normal;
    double distance;
  };
  std::vector<Face> faces;
  for (int k = 0; k < kFaces; ++k) {
    const auto draw = [&](int i) { return uniform(hash(seed, Purpose::texture, k, i), -1, 1); };
    faces.push_back(
        {glm::normalize(Vec3(draw(0), draw(1), draw(2)) + 1e-3), (0.3 + 0.05 * draw(3)) * side});
  }
  std::vector<float> field;
  const double middle = 0.5 * (side - 1), largest = middle - 1;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Vec3 p = Vec3(x, y, z) - middle;
        double inside = largest - glm::length(p);
        for (const Face& face : faces)
          inside = std::min(inside, face.distance - glm::dot(p, face.normal));
        field.push_back(static_cast<float>(std::clamp(inside, -1.0, 1.0)));
      }
  return field;
}

}  // namespace talus::bench
