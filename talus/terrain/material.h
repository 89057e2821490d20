// What ground is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "talus/base/vec.h"

namespace talus {

// In the order in which deposits lie on bedrock, lowest first ([Peytavie2010] §2.1.1.2). A new
// material takes a place in this order and a line in the table behind `material_info`.
enum class Material : std::uint8_t { bedrock, sand, soil, rocks, water, ice, snow, air };
constexpr int kMaterialCount = 8;
constexpr std::size_t index(Material m) { return static_cast<std::size_t>(m); }

enum class MaterialKind { solid, granular, liquid, empty };

struct MaterialInfo {
  std::string_view name;
  MaterialKind kind = MaterialKind::solid;
  double repose_angle_deg = 90;  // steepest slope at which it rests; 0 for liquids
  double density = 0;            // kg / m^3
  Vec3f color{0};                // share of light reflected: linear red, green, blue
};

const MaterialInfo& material_info(Material material);

// All materials, indexed by their number.
std::span<const MaterialInfo> material_infos();

// A set of materials.
class MaterialSet {
 public:
  constexpr MaterialSet() = default;
  constexpr MaterialSet(std::initializer_list<Material> materials) {
    for (const Material m : materials) insert(m);
  }
  constexpr void insert(Material m) { bits_ |= bit(m); }
  constexpr bool contains(Material m) const { return (bits_ & bit(m)) != 0; }
  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool operator==(const MaterialSet&) const = default;

 private:
  static constexpr std::uint32_t bit(Material m) { return 1u << static_cast<unsigned>(m); }
  std::uint32_t bits_ = 0;
};

constexpr MaterialSet kAllMaterials = {Material::bedrock, Material::sand,  Material::soil,
                                       Material::rocks,   Material::water, Material::ice,
                                       Material::snow,    Material::air};

// What the ground mesh shows; stones and water are drawn apart ([Peytavie2010] §2.5.1.1).
constexpr MaterialSet kGroundMaterials = {Material::bedrock, Material::sand, Material::soil,
                                          Material::ice, Material::snow};

}  // namespace talus
