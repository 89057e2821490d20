#include "talus/io/material_color.h"

#include <algorithm>
#include <cmath>

namespace talus {

static_assert(std::tuple_size_v<MaterialShares> == kMaterialCount);

Vec3f blended_color(const MaterialShares& shares) {
  Vec3f color(0);
  for (std::size_t m = 0; m < shares.size(); ++m)
    color += static_cast<float>(shares[m]) / 255.0f * material_infos()[m].color;
  return color;
}

MaterialShares pure(Material material) {
  MaterialShares shares{};
  shares[static_cast<std::size_t>(material)] = 255;
  return shares;
}

std::array<std::uint8_t, 3> linear_bytes(const Vec3f& color) {
  const Vec3f c = glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f;
  return {static_cast<std::uint8_t>(c.x), static_cast<std::uint8_t>(c.y),
          static_cast<std::uint8_t>(c.z)};
}

std::array<std::uint8_t, 3> srgb_bytes(const Vec3f& color) {
  Vec3f encoded;
  for (int c = 0; c < 3; ++c)
    encoded[c] = color[c] <= 0.0031308f
                     ? 12.92f * color[c]
                     : 1.055f * std::pow(std::min(color[c], 1.0f), 1 / 2.4f) - 0.055f;
  return linear_bytes(encoded);
}

}  // namespace talus
