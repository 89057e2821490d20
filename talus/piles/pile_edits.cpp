#include "talus/piles/pile_edits.h"

#include <algorithm>

#include "talus/base/angle.h"
#include "talus/piles/cube_stones.h"

namespace talus {
namespace {

// A stone that exists.
struct Found {
  Int3 cube;
  std::uint32_t number;
  std::uint32_t stone;
};

Found find_stone(const Pile& pile, const StoneId& id) {
  const TileSet& tiles = *pile.tiles;
  const int period = tiles.params().n - 1;
  const Int3 cube = piles::cube_of(id.cell, period);
  piles::CubeStones stones(tiles);
  stones.go_to(cube);
  const std::size_t cell = stones.index_of(id.cell - period * cube);
  const TileSet::Run run = stones.run(cell);
  const auto at = fmt::format("cell ({}, {}, {})", id.cell.x, id.cell.y, id.cell.z);
  if (id.seed < 0 || id.seed >= static_cast<int>(run.count))
    throw usage_error(
        fmt::format("{} has no stone {}; it has {}, counted from 0", at, id.seed, run.count));
  const auto seed = static_cast<std::uint32_t>(id.seed);
  if (!tiles.stones()[run.first + seed].mesh)
    throw usage_error(fmt::format("stone {} of {} is empty", id.seed, at));
  return {cube, stones.first_number(cell) + seed, run.first + seed};
}

bool is_set(const Pile& pile, const Found& found) {
  const std::optional<std::size_t> cube = pile.stones.find(found.cube);
  return cube && test_bit(pile.stones.words(*cube), found.number);
}

void set(Pile& pile, const Found& found, bool value) {
  std::vector<std::uint64_t> words(pile.stones.words_per_cube());
  if (const std::optional<std::size_t> cube = pile.stones.find(found.cube))
    std::ranges::copy(pile.stones.words(*cube), words.begin());
  set_bit(words, found.number, value);
  pile.stones.put(found.cube, words);
  pile.stats.instances += value ? 1 : -1;
}

void forget_move(Pile& pile, const StoneId& stone) {
  pile.stats.instances -=
      std::erase_if(pile.moved, [&](const MovedStone& m) { return m.id == stone; });
}

}  // namespace

void remove_stone(Pile& pile, const StoneId& stone) {
  const Found found = find_stone(pile, stone);
  if (is_set(pile, found)) set(pile, found, false);
  forget_move(pile, stone);
}

void place_stone(Pile& pile, const StoneId& stone) {
  const Found found = find_stone(pile, stone);
  forget_move(pile, stone);
  if (!is_set(pile, found)) set(pile, found, true);
}

void move_stone(Pile& pile, const StoneMove& move) {
  const Found found = find_stone(pile, move.stone);
  remove_stone(pile, move.stone);
  const Vec3 pivot = Vec3(move.stone.cell) + pile.tiles->stones()[found.stone].pivot;
  pile.moved.push_back(
      {.id = move.stone,
       .stone = found.stone,
       .position = pile.tiling.world(pivot) + move.by,
       .rotation = Quat(glm::quat_cast(rotation_deg(move.rotate_deg) * pile.tiling.turn))});
  ++pile.stats.instances;
}

void replace_part(Pile& pile, const CubeBox& cubes, const Pile& part) {
  CubeBits stones(pile.stones.words_per_cube());
  const auto is_replaced = [&](const Int3& cube) { return cubes.contains(cube); };
  std::size_t i = 0;  // of the part's cubes, all of which are replaced ones
  for (std::size_t k = 0; k < pile.stones.size(); ++k) {
    const Int3& cube = pile.stones.cube(k);
    if (is_replaced(cube)) continue;
    for (; i < part.stones.size() && is_before(part.stones.cube(i), cube); ++i)
      stones.append(part.stones.cube(i), part.stones.words(i));
    stones.append(cube, pile.stones.words(k));
  }
  for (; i < part.stones.size(); ++i) stones.append(part.stones.cube(i), part.stones.words(i));
  pile.stones = std::move(stones);

  const int period = pile.tiles->params().n - 1;
  std::erase_if(pile.moved, [&](const MovedStone& m) {
    return is_replaced(piles::cube_of(m.id.cell, period));
  });
  pile.moved.insert(pile.moved.end(), part.moved.begin(), part.moved.end());
  pile.stats.instances = pile.stones.bit_count() + pile.moved.size();
}

}  // namespace talus
