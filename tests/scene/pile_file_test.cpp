#include "talus/scene/pile_file.h"

#include <gtest/gtest.h>

#include "talus/base/hash.h"
#include "talus/field/shape.h"
#include "talus/io/read_file.h"
#include "talus/piles/pile_edits.h"
#include "talus/scene/outputs.h"
#include "temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigestDigits = 32;
constexpr std::size_t kFlagAt = 8;  // after the magic: whether there is a mesh report

std::shared_ptr<const TileSet> tiles() {
  static const auto made =
      std::make_shared<const TileSet>(TileSet::make({.n = 5, .voxels_per_edge = 20}, 7));
  return made;
}

FilledSupport heap() {
  Pile pile = fill(ShapeSupport(Sphere{.radius = 2}), tiles(),
                   {.stone_size = {0.8}, .tiling = {.rotate_deg = {10, 20, 30}}});
  move_stone(pile, {.stone = {.cell = placed_stones(pile).back().cell}, .by = {0, 0, 2}});
  return {.pile = std::move(pile),
          .mesh = MeshSupportReport{.triangles = 12, .inverted = true, .volume = 3}};
}

// Replaces the file by one of these contents whose digest is right.
void put_body(const fs::path& file, const std::string& body) {
  Digest digest;
  digest.add(body);
  write_text(file, body + digest.hex());
}

TEST(PileFile, LoadsWhatWasSaved) {
  const TemporaryFolder folder;
  const FilledSupport saved = heap();
  save_pile(folder / "a.pile", saved);
  const FilledSupport loaded = load_pile(folder / "a.pile", tiles());
  EXPECT_EQ(loaded.pile.tiling.origin, saved.pile.tiling.origin);
  EXPECT_EQ(loaded.pile.tiling.turn, saved.pile.tiling.turn);
  EXPECT_EQ(loaded.pile.tiling.cell_size, saved.pile.tiling.cell_size);
  EXPECT_EQ(loaded.pile.floor, saved.pile.floor);
  EXPECT_EQ(loaded.pile.stats.instances, saved.pile.stats.instances);
  EXPECT_EQ(loaded.pile.stones, saved.pile.stones);
  ASSERT_EQ(loaded.pile.moved.size(), 1u);
  EXPECT_EQ(loaded.pile.moved[0].id, saved.pile.moved[0].id);
  EXPECT_EQ(loaded.pile.moved[0].stone, saved.pile.moved[0].stone);
  EXPECT_EQ(loaded.pile.moved[0].position, saved.pile.moved[0].position);
  EXPECT_EQ(loaded.pile.moved[0].rotation, saved.pile.moved[0].rotation);
  ASSERT_TRUE(loaded.mesh);
  EXPECT_EQ(loaded.mesh->triangles, 12u);
  EXPECT_TRUE(loaded.mesh->inverted);
  EXPECT_EQ(loaded.mesh->volume, 3);
}

// The digest keeps accidents out; contents that carry a right one are still not believed.
TEST(PileFile, RefusesBodiesThatAreNoPile) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.pile";
  save_pile(file, heap());
  const std::string whole = read_file(file);
  const std::string body = whole.substr(0, whole.size() - kDigestDigits);
  const auto refuses = [&](const std::string& broken) {
    put_body(file, broken);
    try {
      load_pile(file, tiles());
      ADD_FAILURE() << "read " << broken.size() << " bytes";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
    }
  };
  constexpr std::size_t kCubeBytes = 3 * sizeof(int) + sizeof(std::uint64_t);
  for (std::size_t cut = 1; cut < kCubeBytes; ++cut) {
    refuses(body.substr(0, body.size() - cut));
    refuses(body + std::string(cut, '\0'));
  }
  for (std::size_t size = 0; size < 100; ++size) refuses(body.substr(0, size));
  std::string no_flag = body;
  no_flag[kFlagAt] = 7;
  refuses(no_flag);
  // Cubes that are there twice, or out of order.
  refuses(body + body.substr(body.size() - kCubeBytes));
  refuses(body + body.substr(body.size() - 3 * kCubeBytes, kCubeBytes));
}

}  // namespace
}  // namespace talus
