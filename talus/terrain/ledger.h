// Where matter went: what an edit added, removed and turned into something else, to the step.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "talus/terrain/material.h"

namespace talus {

// Thickness in steps, summed over columns, by material. The entry of air is 0: air is not matter.
using MaterialSteps = std::array<std::int64_t, kMaterialCount>;

// Matter that became other matter. The numbers of steps differ where the densities do; air gives
// way or fills the rest.
struct Conversion {
  Material from = Material::air;
  Material to = Material::air;
  std::int64_t from_steps = 0;
  std::int64_t to_steps = 0;
};

// What went of each material, and what came of another instead. Integers, so that the order of
// bookings never shows.
class Booking {
 public:
  // One material took the place of another.
  void replace(Material from, Material to, std::int64_t steps) {
    convert({from, to, steps, steps});
  }
  // From a material to itself nothing is booked.
  void convert(const Conversion& c);
  void add(const Booking& other);

  // Of air that became the material, of the material that became air, of any other pair.
  std::int64_t added(Material m) const { return replaced(Material::air, m); }
  std::int64_t removed(Material m) const { return replaced(m, Material::air); }
  std::int64_t replaced(Material from, Material to) const { return gone_[index(from)][index(to)]; }
  // The same pair with what came instead.
  Conversion conversion(Material from, Material to) const {
    return {from, to, gone_[index(from)][index(to)], come_[index(from)][index(to)]};
  }

  // What the bookings make of a volume.
  MaterialSteps change() const;

  bool operator==(const Booking&) const = default;

 private:
  std::array<MaterialSteps, kMaterialCount> gone_{};  // [from][to], in steps of `from`
  std::array<MaterialSteps, kMaterialCount> come_{};  // [from][to], in steps of `to`
};

// One operation's line in a scene's ledger.
struct LedgerEntry {
  std::string operation;
  Booking booking;
  bool balanced = false;  // volumes before and after differ by exactly the booking's change
};

}  // namespace talus
