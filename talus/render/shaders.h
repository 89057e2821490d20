// Texts of the files in shaders/, embedded at build time by embed_shaders.cmake.
#pragma once

#include <string_view>

namespace talus::shaders {

extern const std::string_view common_glsl;  // goes before every other one
extern const std::string_view fullscreen_vert;
extern const std::string_view ground_frag;
extern const std::string_view material_textures_frag;
extern const std::string_view occlusion_frag;
extern const std::string_view occlusion_blur_frag;
extern const std::string_view picture_frag;
extern const std::string_view shadow_vert;
extern const std::string_view surface_vert;
extern const std::string_view surface_frag;

}  // namespace talus::shaders
