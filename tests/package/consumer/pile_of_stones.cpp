// A user's program: fills a sphere of 1 m radius with stones and says how many there are.
#include <cstdio>
#include <memory>

#include "talus/field/shape.h"
#include "talus/piles/pile.h"
#include "talus/rocks/tile_set.h"

int main() {
  const auto tiles = std::make_shared<const talus::TileSet>(talus::TileSet::make({}, 1));
  const talus::ShapeSupport sphere(talus::Sphere{.radius = 1});
  const talus::Pile pile =
      talus::fill(sphere, tiles, {.stone_size = talus::parse_relative_length("10%")});
  const talus::InstanceTable table = talus::instances(pile);
  std::printf("%zu stones of %zu meshes\n", table.instances.size(), table.prototypes.size());
}
