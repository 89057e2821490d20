// Texts of the files in shaders/, embedded at build time by embed_shaders.cmake.
#pragma once

#include <string_view>

namespace talus::shaders {

extern const std::string_view common_glsl;  // goes before every other one
extern const std::string_view landscape_glsl;
extern const std::string_view light_glsl;
extern const std::string_view noise_glsl;
extern const std::string_view stones_glsl;
extern const std::string_view clouds_frag;
extern const std::string_view depth_vert;
extern const std::string_view fullscreen_vert;
extern const std::string_view gravel_texture_frag;
extern const std::string_view ground_frag;
extern const std::string_view occlusion_frag;
extern const std::string_view occlusion_blur_frag;
extern const std::string_view picture_frag;
extern const std::string_view stone_textures_frag;
extern const std::string_view surface_frag;
extern const std::string_view surface_vert;
extern const std::string_view surface_images_frag;
extern const std::string_view surface_pattern_frag;
extern const std::string_view surface_relief_frag;

}  // namespace talus::shaders
