#include "talus/piles/pile.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "talus/piles/cube_stones.h"

namespace talus {
namespace {

// `visit(cell, stone index)` for every stone that lies where the tiling has it.
void for_each_stone(const Pile& pile, auto&& visit) {
  const int period = pile.tiles->params().n - 1;
  piles::CubeStones stones(*pile.tiles);
  for (std::size_t i = 0; i < pile.stones.size(); ++i) {
    const Int3& cube = pile.stones.cube(i);
    stones.go_to(cube);
    for_each_bit(pile.stones.words(i), [&](std::uint32_t number) {
      visit(period * cube + stones.cell_at(stones.cell_of(number)), stones.stone(number));
    });
  }
}

}  // namespace

std::vector<CubeBox> split(const CubeBox& all, std::uint64_t cubes_max) {
  if (all.volume() <= static_cast<double>(std::max<std::uint64_t>(1, cubes_max))) return {all};
  const Int3& size = all.size;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  CubeBox lower = all, upper = all;
  lower.size[axis] = size[axis] / 2;
  upper.first[axis] += lower.size[axis];
  upper.size[axis] -= lower.size[axis];
  std::vector<CubeBox> parts = split(lower, cubes_max);
  const std::vector<CubeBox> more = split(upper, cubes_max);
  parts.insert(parts.end(), more.begin(), more.end());
  return parts;
}

std::vector<PlacedStone> placed_stones(const Pile& pile) {
  std::vector<PlacedStone> placed;
  placed.reserve(pile.stones.bit_count());
  for_each_stone(pile, [&](const Int3& cell, std::uint32_t stone) {
    placed.push_back({cell, stone});
  });
  return placed;
}

InstanceTable instances(const Pile& pile) {
  const std::span<const Stone> stones = pile.tiles->stones();
  std::vector<std::size_t> uses(stones.size());
  for_each_stone(pile, [&](const Int3&, std::uint32_t stone) { ++uses[stone]; });
  for (const MovedStone& moved : pile.moved) ++uses[moved.stone];

  // Prototypes in the tile set's order; stones that share a mesh share the prototype.
  InstanceTable table;
  std::vector<std::uint32_t> prototype(stones.size());
  std::vector<std::size_t> next;  // per prototype, where its instances begin
  std::unordered_map<const TriangleMesh*, std::uint32_t> known;  // only looked up, never iterated
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (uses[i] == 0) continue;
    const auto [entry, is_new] = known.try_emplace(
        stones[i].mesh.get(), static_cast<std::uint32_t>(table.prototypes.size()));
    if (is_new) {
      table.prototypes.push_back(stones[i].mesh);
      next.push_back(0);
    }
    prototype[i] = entry->second;
    next[prototype[i]] += uses[i];
  }
  const std::size_t count = std::accumulate(next.begin(), next.end(), std::size_t{0});
  std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});

  table.instances.resize(count);
  const auto scale = static_cast<float>(pile.tiling.cell_size);
  const Quat turn(glm::quat_cast(pile.tiling.turn));
  for_each_stone(pile, [&](const Int3& cell, std::uint32_t stone) {
    table.instances[next[prototype[stone]]++] = {
        .position = pile.tiling.world(Vec3(cell) + stones[stone].pivot),
        .rotation = turn,
        .scale = scale,
        .prototype = prototype[stone],
        .name = {.cell = cell, .seed = stones[stone].seed}};
  });
  for (const MovedStone& moved : pile.moved)
    table.instances[next[prototype[moved.stone]]++] = {
        .position = moved.position,
        .rotation = moved.rotation,
        .scale = scale,
        .prototype = prototype[moved.stone],
        .name = {.cell = moved.id.cell, .seed = stones[moved.stone].seed}};
  return table;
}

}  // namespace talus
