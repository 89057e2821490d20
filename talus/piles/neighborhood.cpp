#include "talus/piles/neighborhood.h"

#include <algorithm>

namespace talus::piles {
namespace {

// Whether a contact lies between stones of one cube.
bool is_within(const Int3& cell, int period) {
  return std::min({cell.x, cell.y, cell.z}) >= 0 && std::max({cell.x, cell.y, cell.z}) < period;
}

bool keeps(const Stone& stone, const Int3& cell, std::uint16_t seed) {
  return std::any_of(stone.contacts.begin(), stone.contacts.end(), [&](const StoneContact& c) {
    return c.kept && c.cell == cell && c.seed == seed;
  });
}

}  // namespace

Neighborhood::Neighborhood(const TileSet& tiles, const CubeBits& cubes)
    : tiles_(tiles),
      cubes_(cubes),
      period_(tiles.params().n - 1),
      around_(27, Cube{.stones = CubeStones(tiles)}) {}

void Neighborhood::go_to(std::size_t cube) {
  center_ = cubes_.cube(cube);
  for (Cube& other : around_) other.is_known = other.is_numbered = false;
}

Neighborhood::Cube& Neighborhood::cube_at(const Int3& offset) {
  Cube& cube =
      around_[static_cast<std::size_t>(offset.x + 1 + 3 * (offset.y + 1) + 9 * (offset.z + 1))];
  if (!cube.is_known) cube.index = cubes_.find(center_ + offset);
  cube.is_known = true;
  return cube;
}

CubeStones& Neighborhood::numbered(Cube& cube, const Int3& offset) {
  if (!cube.is_numbered) cube.stones.go_to(center_ + offset);
  cube.is_numbered = true;
  return cube.stones;
}

Neighborhood::Place Neighborhood::place_of(std::uint32_t number) {
  const CubeStones& stones = numbered(cube_at(Int3(0)), Int3(0));
  return {stones.cell_at(stones.cell_of(number)), &tiles_.stones()[stones.stone(number)]};
}

std::optional<StonePlace> Neighborhood::touching(const Place& place, const StoneContact& contact) {
  if (!contact.kept) return std::nullopt;
  const Int3 at = place.cell + contact.cell;
  const Int3 offset = cube_of(at, period_);
  Cube& cube = cube_at(offset);
  if (!cube.index) return std::nullopt;
  const CubeStones& stones = numbered(cube, offset);
  const std::size_t cell = stones.index_of(at - period_ * offset);
  const std::uint32_t number = stones.first_number(cell) + contact.seed;
  if (!test_bit(cubes_.words(*cube.index), number)) return std::nullopt;
  const Stone& other = tiles_.stones()[stones.run(cell).first + contact.seed];
  if (!keeps(other, -contact.cell, place.stone->seed)) return std::nullopt;
  return StonePlace{*cube.index, number};
}

bool Neighborhood::touches_any(std::uint32_t number) {
  const Place place = place_of(number);
  // Neighbors in the same cube are found sooner.
  for (const bool within : {true, false})
    for (const StoneContact& contact : place.stone->contacts)
      if (is_within(place.cell + contact.cell, period_) == within && touching(place, contact))
        return true;
  return false;
}

}  // namespace talus::piles
