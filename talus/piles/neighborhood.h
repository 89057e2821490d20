// Which stones of a pile touch each other.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "talus/piles/cube_bits.h"
#include "talus/piles/cube_stones.h"

namespace talus::piles {

// A stone of a set of cubes: the cube's index there, and the stone's number in the cube.
struct StonePlace {
  std::size_t cube;
  std::uint32_t number;
};

// Looks up the neighbors of one cube's stones in a set of cubes, which must outlive it. Working
// memory of one thread.
class Neighborhood {
 public:
  Neighborhood(const TileSet& tiles, const CubeBits& cubes);

  void go_to(std::size_t cube);

  // Whether a stone of the cube touches another one of the set.
  bool touches_any(std::uint32_t number);
  // `visit(StonePlace)` for each stone of the set that a stone of the cube touches: both keep the
  // contact.
  void for_each_touching(std::uint32_t number, auto&& visit) {
    const Place place = place_of(number);
    for (const StoneContact& contact : place.stone->contacts)
      if (const std::optional<StonePlace> other = touching(place, contact)) visit(*other);
  }

 private:
  struct Place {
    Int3 cell;  // relative to the cube
    const Stone* stone;
  };
  // A cube next to the present one, or that one.
  struct Cube {
    std::optional<std::size_t> index;  // in the set, once looked up
    bool is_known = false;
    CubeStones stones;
    bool is_numbered = false;
  };

  Place place_of(std::uint32_t number);
  std::optional<StonePlace> touching(const Place& place, const StoneContact& contact);
  Cube& cube_at(const Int3& offset);
  CubeStones& numbered(Cube& cube, const Int3& offset);

  const TileSet& tiles_;
  const CubeBits& cubes_;
  int period_;
  Int3 center_{0};
  std::vector<Cube> around_;  // 27, x fastest
};

}  // namespace talus::piles
