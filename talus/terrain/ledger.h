// Where matter went: what an edit added, removed and turned into something else, to the step.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "talus/terrain/material.h"

namespace talus {

// Thickness in steps, summed over columns, by material.
using MaterialSteps = std::array<std::int64_t, kMaterialCount>;

// How many steps of one material took the place of another. Integers, so that the order of bookings
// never shows.
class Booking {
 public:
  void replace(Material from, Material to, std::int64_t steps) {
    if (from != to) steps_[index(from)][index(to)] += steps;
  }
  void add(const Booking& other);

  // Of air that became the material, of the material that became air, of any other pair.
  std::int64_t added(Material m) const { return replaced(Material::air, m); }
  std::int64_t removed(Material m) const { return replaced(m, Material::air); }
  std::int64_t replaced(Material from, Material to) const { return steps_[index(from)][index(to)]; }

  // What the bookings make of a volume. The open air above columns is not counted: the entry of air
  // is 0.
  MaterialSteps change() const;

 private:
  static std::size_t index(Material m) { return static_cast<std::size_t>(m); }
  std::array<MaterialSteps, kMaterialCount> steps_{};
};

// One operation's line in a scene's ledger.
struct LedgerEntry {
  std::string operation;
  Booking booking;
  bool balanced = false;  // volumes before and after differ by exactly the booking's change
};

}  // namespace talus
