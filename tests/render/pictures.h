// Looking at pictures.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "talus/base/image.h"
#include "talus/base/vec.h"
#include "talus/render/headless_context.h"

namespace talus::test {

// Fails at once, and says why, where there is no OpenGL to draw with: the set-up installs one.
class Picture : public testing::Test {
 protected:
  void SetUp() override { const HeadlessContext context; }
};

inline glm::ivec3 pixel(const Image& image, int x, int y) {
  const std::size_t i = 3 * static_cast<std::size_t>(x + image.width * y);
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

// Mean color of the square that reaches `reach` pixels from a place.
inline Vec3 mean(const Image& image, const glm::ivec2& place, int reach) {
  Vec3 sum(0);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) sum += Vec3(pixel(image, place.x + dx, place.y + dy));
  return sum / ((2.0 * reach + 1) * (2.0 * reach + 1));
}

// Sum of the channels, averaged over the square of 2 * 5 + 1 pixels around a place.
inline double brightness(const Image& image, int x, int y) {
  const Vec3 color = mean(image, {x, y}, 5);
  return color.x + color.y + color.z;
}

// Pixels in which two pictures differ by more than `tolerance` in some channel.
inline std::vector<glm::ivec2> changes(const Image& a, const Image& b, int tolerance = 0) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  std::vector<glm::ivec2> places;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const glm::ivec3 d = glm::abs(pixel(a, x, y) - pixel(b, x, y));
      if (std::max({d.x, d.y, d.z}) > tolerance) places.emplace_back(x, y);
    }
  return places;
}

}  // namespace talus::test
