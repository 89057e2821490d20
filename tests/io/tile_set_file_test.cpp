#include "talus/io/tile_set_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "io/scratch.h"
#include "talus/io/digest.h"
#include "talus/io/inspect.h"
#include "talus/io/tile_set_codec.h"

namespace talus {
namespace {

using test::bytes_of;
using test::Refusal;
using test::refusal_of;
using test::Scratch;

// The smallest set that the parameters allow.
const TileSet& tiles() {
  static const TileSet made = TileSet::make({.n = 5, .voxels_per_edge = 20, .axis_x = {1, 2}}, 7);
  return made;
}

std::string digest_of(const TileSet& set) {
  Digest digest;
  add_to(digest, set);
  return digest.hex();
}

std::string body_of(const TileSet& set) {
  std::string body;
  TileSetCodec::write(set, [&](std::string_view piece) { body += piece; });
  return body;
}

TEST(TileSetFile, HasTheSizeThatIsToldBefore) {
  EXPECT_EQ(TileSetCodec::size(tiles()), body_of(tiles()).size());
}

TEST(TileSetFile, LoadsWhatWasSavedBitForBit) {
  const Scratch scratch;
  save_tile_set(scratch.path("a.tiles"), tiles());
  const TileSet loaded = load_tile_set(scratch.path("a.tiles"));
  EXPECT_EQ(digest_of(loaded), digest_of(tiles()));
  EXPECT_EQ(loaded.seed(), 7u);
  EXPECT_EQ(loaded.params().voxels_per_edge, 20);
  EXPECT_EQ(loaded.params().axis_x.max, 2);
  EXPECT_EQ(loaded.reach(), tiles().reach());
  EXPECT_EQ(loaded.stats().contacts_mean, tiles().stats().contacts_mean);

  ASSERT_EQ(loaded.stones().size(), tiles().stones().size());
  for (std::size_t i = 0; i < loaded.stones().size(); ++i) {
    const Stone &a = loaded.stones()[i], &b = tiles().stones()[i];
    ASSERT_EQ(a.pivot, b.pivot);
    ASSERT_EQ(a.solid.bits, b.solid.bits);
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    ASSERT_EQ(a.mesh == nullptr, b.mesh == nullptr);
    if (a.mesh) {
      ASSERT_EQ(a.mesh->positions, b.mesh->positions);
      ASSERT_EQ(a.mesh->triangles, b.mesh->triangles);
    }
  }
  const Int3 cell(0, 1, 2);
  const CornerColors corners = {0, 1, 0, 1, 1, 0, 0, 1};
  EXPECT_EQ(loaded.stones_of(cell, corners).first, tiles().stones_of(cell, corners).first);
}

TEST(TileSetFile, KeepsTheVariety) {
  const Scratch scratch;
  for (const Variety variety : {Variety::columns, Variety::periodic}) {
    const TileSet made = TileSet::make({.variety = variety, .n = 5, .voxels_per_edge = 20}, 7);
    save_tile_set(scratch.path("a.tiles"), made);
    const TileSet loaded = load_tile_set(scratch.path("a.tiles"));
    EXPECT_EQ(loaded.params().variety, variety);
    EXPECT_EQ(digest_of(loaded), digest_of(made));
    const Int3 cell(-3, 7, 11);
    EXPECT_EQ(loaded.stones_at(cell).first, made.stones_at(cell).first);
  }
}

TEST(TileSetFile, SharesMeshesAsTheSetDid) {
  const Scratch scratch;
  save_tile_set(scratch.path("a.tiles"), tiles());
  const TileSet loaded = load_tile_set(scratch.path("a.tiles"));
  for (std::size_t i = 1; i < loaded.stones().size(); ++i)
    EXPECT_EQ(loaded.stones()[i].mesh == loaded.stones()[0].mesh,
              tiles().stones()[i].mesh == tiles().stones()[0].mesh);
}

TEST(TileSetFile, DigestSeesTheSeed) {
  const TileSet other = TileSet::make({.n = 5, .voxels_per_edge = 20, .axis_x = {1, 2}}, 8);
  EXPECT_NE(digest_of(other), digest_of(tiles()));
}

TEST(TileSetFile, RefusesTruncationsAndAppendedBytes) {
  const Scratch scratch;
  save_tile_set(scratch.path("a.tiles"), tiles());
  const std::string bytes = bytes_of(scratch.path("a.tiles"));
  const auto refuses = [&](const std::string& broken) {
    const auto path = scratch.file("b.tiles", broken);
    const Refusal refusal = refusal_of([&] { load_tile_set(path); });
    EXPECT_EQ(refusal.kind, ErrorKind::input);
    EXPECT_TRUE(refusal.line.starts_with(path.string())) << refusal.line;
  };
  for (std::size_t size = 0; size < 64; ++size) refuses(bytes.substr(0, size));
  for (std::size_t i = 1; i < 10; ++i) refuses(bytes.substr(0, i * bytes.size() / 10));
  refuses(bytes.substr(0, bytes.size() - 1));
  refuses(bytes + '\0');
}

TEST(TileSetFile, RefusesAnyFlippedByte) {
  const Scratch scratch;
  save_tile_set(scratch.path("a.tiles"), tiles());
  const std::string bytes = bytes_of(scratch.path("a.tiles"));
  const auto refuses = [&](std::size_t at) {
    std::string broken = bytes;
    broken[at] = static_cast<char>(broken[at] ^ 0x10);
    const auto path = scratch.file("b.tiles", broken);
    EXPECT_EQ(refusal_of([&] { load_tile_set(path); }).kind, ErrorKind::input) << at;
  };
  for (std::size_t at = 0; at < 24; at += 3) refuses(at);
  for (std::size_t i = 1; i < 10; ++i) refuses(i * bytes.size() / 10);
  for (std::size_t back = 1; back <= 32; back += 8) refuses(bytes.size() - back);
}

// Looks up the stones of every cell for all colors at its cube's corners.
void look_up_everything(const TileSet& set) {
  const int period = set.params().n - 1;
  for (int i = 0; i < period * period * period; ++i)
    for (int code = 0; code < 256; ++code) {
      CornerColors corners;
      for (int corner = 0; corner < 8; ++corner)
        corners[static_cast<std::size_t>(corner)] = static_cast<std::uint8_t>(code >> corner & 1);
      const Int3 cell(i % period, i / period % period, i / (period * period));
      const TileSet::Run run = set.stones_of(cell, corners);
      ASSERT_LE(std::uint64_t{run.first} + run.count, set.stones().size());
    }
}

// Where the body's last lists end: the reach, eleven statistics and a flag follow.
constexpr std::size_t kTailBytes = 8 + 11 * 8 + 1;
constexpr std::size_t kCellRunsBytes = 4 * 4 * 4 * sizeof(std::uint32_t);

TEST(TileSetCodec, RunsThatDoNotCoverTheStonesAreRefused) {
  const std::string body = body_of(tiles());
  look_up_everything(TileSetCodec::decode(body));
  const std::size_t runs_end = body.size() - kTailBytes;
  const auto refuses = [](const std::string& broken) {
    EXPECT_EQ(refusal_of([&] { TileSetCodec::decode(broken); }).kind, ErrorKind::input);
  };
  const auto with = [&](std::size_t at, auto value) {
    std::string changed = body;
    std::memcpy(changed.data() + at, &value, sizeof value);
    return changed;
  };
  // Where a cell's runs start, then where the runs themselves end.
  for (std::size_t back = 4; back <= kCellRunsBytes; back += 36)
    for (const std::uint32_t value : {1u, 70'000u, 0xffffffffu})
      refuses(with(runs_end - back, value));
  const std::size_t last_run = runs_end - kCellRunsBytes - 8 - 4;
  const auto stones = static_cast<std::uint32_t>(tiles().stones().size());
  for (const std::uint32_t value : {0u, stones - 1, stones + 1, 0xffffffffu})
    refuses(with(last_run, value));
  refuses(with(last_run - 4, stones + 1));

  // A cell too few, and parameters that want another number of cells or do not fit together.
  std::string fewer = with(runs_end - kCellRunsBytes - 8, std::uint64_t{63});
  refuses(fewer.erase(runs_end - 4, 4));
  constexpr std::size_t kAtVariety = 0, kAtN = 1;
  refuses(with(kAtN, std::int32_t{10}));
  refuses(with(kAtN, std::int32_t{7}));
  refuses(with(kAtVariety, std::uint8_t{1}));
  refuses(with(kAtVariety, std::uint8_t{3}));
}

TEST(TileSetCodec, AbsurdReachIsRefused) {
  const std::string body = body_of(tiles());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double reach : {-1.0, 1e9, infinity, -infinity, std::nan("")}) {
    std::string broken = body;
    std::memcpy(broken.data() + body.size() - kTailBytes, &reach, sizeof reach);
    EXPECT_EQ(refusal_of([&] { TileSetCodec::decode(broken); }).kind, ErrorKind::input) << reach;
  }
}

// The checksum keeps accidents out; contents that carry a right one are still not believed.
TEST(TileSetCodec, SurvivesAnyBody) {
  const std::string body = body_of(tiles());
  const auto survives = [](const std::string& broken) {
    try {
      look_up_everything(TileSetCodec::decode(broken));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
    }
  };
  for (std::size_t i = 0; i < 60; ++i) {
    const std::string cut = body.substr(0, i < 50 ? i * 8 : (i - 50) * body.size() / 10);
    EXPECT_EQ(refusal_of([&] { TileSetCodec::decode(cut); }).kind, ErrorKind::input);
  }
  for (std::size_t i = 0; i < 24; ++i) {
    std::string broken = body;
    const std::size_t at = i < 16 ? i * 12 : hash(1, Purpose::texture, i) % body.size();
    std::memset(broken.data() + at, static_cast<int>(hash(2, Purpose::texture, i) & 0xff),
                std::min<std::size_t>(4, body.size() - at));
    survives(broken);
  }
}

TEST(TileSetFile, NamesWhatIsNoTileSet) {
  const Scratch scratch;
  const auto line = [&](std::string_view bytes) {
    const auto path = scratch.file("a.tiles", bytes);
    return refusal_of([&] { load_tile_set(path); }).line.substr(path.string().size());
  };
  EXPECT_EQ(line("a letter"), ": no tile set; `talus tiles -o FILE` makes one");
  EXPECT_EQ(line(std::string("TALUSTIL\x09\0\0\0........", 20)),
            ": tile set of format 9, but this version reads 3; make it again");
  EXPECT_EQ(line(std::string("TALUSTIL\x02\0\0\0........", 20)),
            ": tile set of format 2, but this version reads 3; make it again");
}

TEST(Inspect, LoadsATileSet) {
  const Scratch scratch;
  save_tile_set(scratch.path("a.tiles"), tiles());
  const Inspection found = inspect(scratch.path("a.tiles"));
  ASSERT_TRUE(found.tiles);
  EXPECT_EQ(found.tiles->stones().size(), tiles().stones().size());
  EXPECT_EQ(found.tiles->stats().distinct_meshes, tiles().stats().distinct_meshes);
  EXPECT_EQ(found.tiles->seed(), 7u);
}

}  // namespace
}  // namespace talus
