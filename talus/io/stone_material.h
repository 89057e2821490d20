// What stones look like: procedural, seamless textures.
#pragma once

#include <cstdint>

#include "talus/base/image.h"

namespace talus {

struct StoneTextures {
  Image base_color;           // sRGB
  Image normal;               // tangent space, linear, green along the texture's upward axis
  Image occlusion_roughness;  // linear: red occlusion, green roughness, blue metalness (none)
};

// 512 x 512 pixels each, repeating seamlessly along both axes. One repeat is meant for a patch
// about as large as a stone. A function of the seed alone, bit for bit.
StoneTextures make_stone_textures(std::uint64_t seed);

}  // namespace talus
