// How a recipe wants the ground's materials to look in pictures.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "talus/base/describe.h"
#include "talus/base/vec.h"
#include "talus/scene/fields.h"
#include "talus/terrain/material.h"

namespace talus {

// Of one material: a color, or pictures instead of the pattern that the renderer draws.
struct SurfaceParams {
  std::optional<Vec3> color;
  std::optional<std::filesystem::path> albedo;
  std::optional<std::filesystem::path> normal;
  std::optional<std::filesystem::path> roughness;
  std::optional<std::filesystem::path> height;
  double size = 2;

  static void describe(auto& p, auto&& field) {
    field(p.color, Field{.name = "color",
                         .help = "share of light that it reflects on average: linear red, green "
                                 "and blue, each from 0 to 1",
                         .min = 0,
                         .max = 1});
    field(p.albedo, Field{.name = "albedo",
                          .help = "picture of its color, relative to the recipe; a fourth channel "
                                  "is its height"});
    field(p.normal, Field{.name = "normal",
                          .help = "picture of its normals, y up the picture; a fourth channel is "
                                  "its roughness"});
    field(p.roughness,
          Field{.name = "roughness", .help = "grey picture of its roughness: white is dull"});
    field(p.height, Field{.name = "height",
                          .help = "grey picture of its height: what is high shows first where "
                                  "materials meet"});
    field(p.size, Field{.name = "size",
                        .help = "length that the pictures cover before they repeat",
                        .unit = "m",
                        .min = 1e-3,
                        .max = 1e6});
  }
};

// Of every material that the ground mesh shows, by the material's name.
struct SurfacesParams {
  std::array<SurfaceParams, kMaterialCount> of_material;

  static void describe(auto& p, auto&& field) {
    for (int m = 0; m < kMaterialCount; ++m)
      if (const auto material = static_cast<Material>(m); kGroundMaterials.contains(material))
        field(p.of_material[index(material)],
              Field{.name = material_info(material).name, .help = "how this material looks"});
  }
};

// Reads one material's surface. Throws `Error` (usage), besides what single fields refuse, for a
// color beside a picture of it.
void read_value(const Value& value, const std::string& path, SurfaceParams& out);

}  // namespace talus
