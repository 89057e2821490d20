#include "talus/scene/pile_file.h"

#include <span>
#include <string_view>
#include <utility>

#include "talus/piles/cube_stones.h"
#include "talus/scene/sealed_file.h"

namespace talus {
namespace {

// Layout: the fields of `Pile` and of the mesh report in the order of `each_field`, the moved
// stones, then the cubes, each its place and its words.
constexpr std::string_view kMagic = "TALUSPL3";

void each_field(auto& pile, auto&& report, auto&& field) {
  for (int axis = 0; axis < 3; ++axis) field(pile.tiling.origin[axis]);
  for (int axis = 0; axis < 3; ++axis)
    for (int row = 0; row < 3; ++row) field(pile.tiling.turn[axis][row]);
  field(pile.tiling.cell_size);
  field(pile.floor);
  field(pile.stats.instances);
  field(pile.stats.unique);
  field(pile.stats.hidden);
  field(pile.stats.isolated);
  field(pile.stats.thinned);
  field(pile.stats.chosen_voxels);
  field(pile.stats.seeded_voxels);
  field(report.triangles);
  field(report.degenerate);
  field(report.duplicates);
  field(report.flipped);
  field(report.boundary_edges);
  field(report.non_manifold_edges);
  field(report.inverted);
  field(report.overlapping);
  field(report.volume);
}

void each_field(MovedStone& moved, auto&& field) {
  for (int axis = 0; axis < 3; ++axis) field(moved.id.cell[axis]);
  field(moved.id.seed);
  field(moved.stone);
  for (int axis = 0; axis < 3; ++axis) field(moved.position[axis]);
  for (int k = 0; k < 4; ++k) field(moved.rotation[k]);
}

// Whether the tiling has all stones of these cubes, which come one after another.
bool fits(const TileSet& tiles, const CubeBits& stones) {
  piles::CubeStones numbering(tiles);
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (i > 0 && !is_before(stones.cube(i - 1), stones.cube(i))) return false;
    numbering.go_to(stones.cube(i));
    bool exist = true;
    for_each_bit(stones.words(i), [&](std::uint32_t number) {
      exist = exist && number < numbering.stone_count() &&
              tiles.stones()[numbering.stone(number)].mesh != nullptr;
    });
    if (!exist) return false;
  }
  return true;
}

}  // namespace

void save_pile(const std::filesystem::path& path, const FilledSupport& filled) {
  SealedWriter writer(kMagic);
  const auto add = [&](const auto& value) { writer.add(value); };
  writer.add(filled.mesh.has_value());
  const Pile& pile = filled.pile;
  each_field(pile, filled.mesh.value_or(MeshSupportReport{}), add);
  add(std::uint64_t{pile.moved.size()});
  for (MovedStone moved : pile.moved) each_field(moved, add);
  for (std::size_t i = 0; i < pile.stones.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) add(pile.stones.cube(i)[axis]);
    writer.add_all(pile.stones.words(i));
  }
  writer.save(path);
}

FilledSupport load_pile(const std::filesystem::path& path, std::shared_ptr<const TileSet> tiles) {
  FilledSupport filled;
  Pile& pile = filled.pile;
  SealedReader reader(path, kMagic);
  const auto read = [&](auto& value) { reader.read(value); };
  bool has_report = false;
  MeshSupportReport report;
  read(has_report);
  each_field(pile, report, read);
  if (has_report) filled.mesh = report;

  std::uint64_t moved_count = 0;
  read(moved_count);
  for (std::uint64_t i = 0; i < moved_count; ++i) {
    each_field(pile.moved.emplace_back(), read);
    reader.require(pile.moved.back().stone < tiles->stones().size());
  }
  pile.stones = CubeBits(piles::words_per_cube(*tiles));
  std::vector<std::uint64_t> words(pile.stones.words_per_cube());
  while (!reader.at_end()) {
    Int3 cube;
    for (int axis = 0; axis < 3; ++axis) read(cube[axis]);
    for (std::uint64_t& word : words) read(word);
    pile.stones.append(cube, words);
  }
  pile.stones.shrink_to_fit();
  if (!fits(*tiles, pile.stones)) throw input_error(path.string() + ": made of another tile set");
  pile.tiles = std::move(tiles);
  return filled;
}

}  // namespace talus
