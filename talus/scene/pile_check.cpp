#include "talus/scene/pile_check.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace talus {
namespace {

// Disjoint sets of stones; each set is named by its first stone.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const auto [first, second] = std::minmax({find(a), find(b)});
    parent_[second] = first;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool keeps(const Stone& stone, const Int3& cell, std::uint16_t seed) {
  return std::any_of(stone.contacts.begin(), stone.contacts.end(), [&](const StoneContact& c) {
    return c.kept && c.cell == cell && c.seed == seed;
  });
}

// The order in which a pile keeps its stones.
bool is_before(const Int3& a, const Int3& b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

}  // namespace

PileCheck check_pile(const Pile& pile) {
  const std::span<const Stone> stones = pile.tiles->stones();
  const std::vector<PlacedStone>& placed = pile.stones;

  Groups groups(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Stone& stone = stones[placed[i].stone];
    for (const StoneContact& contact : stone.contacts) {
      // The contact from the other side is the same one: look at each once.
      const Int3 cell = placed[i].cell + contact.cell;
      if (!contact.kept || is_before(cell, placed[i].cell)) continue;
      const auto first = std::partition_point(
          placed.begin(), placed.end(),
          [&](const PlacedStone& other) { return is_before(other.cell, cell); });
      for (auto it = first; it != placed.end() && it->cell == cell; ++it) {
        const Stone& other = stones[it->stone];
        if (other.seed == contact.seed && keeps(other, -contact.cell, stone.seed))
          groups.join(i, static_cast<std::size_t>(it - placed.begin()));
      }
    }
  }

  // A group stands if one of its stones is seeded in the lowest layer of cells or below.
  std::vector<bool> stands(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (placed[i].cell.z <= 0) stands[groups.find(i)] = true;
  PileCheck check;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    check.groups += groups.find(i) == i;
    check.floating += !stands[groups.find(i)];
  }
  return check;
}

}  // namespace talus
