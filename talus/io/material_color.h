// What color ground is.
#pragma once

#include <array>
#include <cstdint>

#include "talus/mesh/triangle_mesh.h"
#include "talus/terrain/material.h"

namespace talus {

// The materials' colors blended by their shares: linear red, green, blue.
Vec3f blended_color(const MaterialShares& shares);

// Nothing but one material.
MaterialShares pure(Material material);

// In 255ths; `srgb` as pictures have it.
std::array<std::uint8_t, 3> linear_bytes(const Vec3f& color);
std::array<std::uint8_t, 3> srgb_bytes(const Vec3f& color);

}  // namespace talus
