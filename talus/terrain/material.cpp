#include "talus/terrain/material.h"

#include <array>

namespace talus {
namespace {

// Repose angles lie in the ranges of [Peytavie2010] table 2.3. Densities are those of matter in
// bulk, the gaps between grains included.
constexpr std::array<MaterialInfo, kMaterialCount> kInfos = {{
    {"bedrock", MaterialKind::solid, 90, 2650, {0.30f, 0.27f, 0.24f}},
    {"sand", MaterialKind::granular, 33, 1600, {0.56f, 0.43f, 0.27f}},
    {"soil", MaterialKind::granular, 38, 1300, {0.17f, 0.13f, 0.08f}},
    {"rocks", MaterialKind::granular, 42, 1700, {0.33f, 0.31f, 0.29f}},
    {"water", MaterialKind::liquid, 0, 1000, {0.02f, 0.06f, 0.08f}},
    {"ice", MaterialKind::solid, 90, 917, {0.62f, 0.74f, 0.80f}},
    {"snow", MaterialKind::granular, 45, 300, {0.87f, 0.89f, 0.92f}},
    {"air", MaterialKind::empty, 0, 1.2, {1, 1, 1}},
}};

}  // namespace

const MaterialInfo& material_info(Material material) {
  return kInfos[static_cast<std::size_t>(material)];
}

std::span<const MaterialInfo> material_infos() { return kInfos; }

}  // namespace talus
