#include "talus/piles/pile_check.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "talus/base/union_find.h"
#include "talus/piles/neighborhood.h"

namespace talus {
namespace {

// Numbers a pile's stones from 0 in order.
class Ranks {
 public:
  explicit Ranks(const CubeBits& stones) : stones_(stones) {
    for (std::size_t i = 0; i < stones.size(); ++i)
      first_.push_back(first_.back() + count(stones.words(i)));
  }
  std::uint32_t at(const piles::StonePlace& place) const {
    const std::span<const std::uint64_t> words = stones_.words(place.cube);
    const std::size_t word = place.number / 64;
    const std::uint64_t before = (std::uint64_t{1} << (place.number % 64)) - 1;
    return first_[place.cube] + count(words.first(word)) +
           static_cast<std::uint32_t>(std::popcount(words[word] & before));
  }
  std::uint32_t size() const { return first_.back(); }

 private:
  static std::uint32_t count(std::span<const std::uint64_t> words) {
    std::uint32_t bits = 0;
    for (const std::uint64_t word : words) bits += static_cast<std::uint32_t>(std::popcount(word));
    return bits;
  }

  const CubeBits& stones_;
  std::vector<std::uint32_t> first_ = {0};  // per cube, one past the end last
};

}  // namespace

PileCheck check_pile(const Pile& pile) {
  const TileSet& tiles = *pile.tiles;
  const int period = tiles.params().n - 1;
  const Ranks ranks(pile.stones);
  UnionFind groups(ranks.size());
  piles::Neighborhood neighborhood(tiles, pile.stones);
  piles::CubeStones numbering(tiles);
  std::vector<bool> stands(ranks.size());
  std::uint64_t contacts = 0;
  for (std::size_t i = 0; i < pile.stones.size(); ++i) {
    neighborhood.go_to(i);
    numbering.go_to(pile.stones.cube(i));
    for_each_bit(pile.stones.words(i), [&](std::uint32_t number) {
      const std::uint32_t own = ranks.at({i, number});
      neighborhood.for_each_touching(number, [&](const piles::StonePlace& other) {
        groups.join(own, ranks.at(other));
        ++contacts;
      });
      // The lowest layer of cells is what begins at the floor or below.
      const Int3 cell = period * pile.stones.cube(i) + numbering.cell_at(numbering.cell_of(number));
      stands[own] = pile.tiling.world(Vec3(cell) + 0.5).z < pile.floor + pile.tiling.cell_size;
    });
  }

  std::vector<bool> holds(ranks.size());
  for (std::uint32_t i = 0; i < ranks.size(); ++i)
    if (stands[i]) holds[groups.root(i)] = true;
  PileCheck check;
  for (std::uint32_t i = 0; i < ranks.size(); ++i) {
    check.groups += groups.root(i) == i;
    check.floating += !holds[groups.root(i)];
  }
  if (ranks.size() > 0) check.contacts_mean = static_cast<double>(contacts) / ranks.size();
  return check;
}

}  // namespace talus
