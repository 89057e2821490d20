#include "talus/terrain/ledger.h"

namespace talus {

void Booking::convert(const Conversion& c) {
  if (c.from == c.to) return;
  gone_[index(c.from)][index(c.to)] += c.from_steps;
  come_[index(c.from)][index(c.to)] += c.to_steps;
}

void Booking::add(const Booking& other) {
  for (std::size_t from = 0; from < kMaterialCount; ++from)
    for (std::size_t to = 0; to < kMaterialCount; ++to) {
      gone_[from][to] += other.gone_[from][to];
      come_[from][to] += other.come_[from][to];
    }
}

MaterialSteps Booking::change() const {
  MaterialSteps change{};
  for (std::size_t from = 0; from < kMaterialCount; ++from)
    for (std::size_t to = 0; to < kMaterialCount; ++to) {
      change[from] -= gone_[from][to];
      change[to] += come_[from][to];
    }
  change[index(Material::air)] = 0;
  return change;
}

}  // namespace talus
