#include "talus/io/tile_set_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>

#include "talus/base/error.h"
#include "talus/base/hash.h"
#include "talus/io/atomic_file.h"
#include "talus/io/read_file.h"
#include "talus/io/tile_set_codec.h"

namespace talus {
namespace {

constexpr std::string_view kMagic = "TALUSTIL";
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof kVersion + sizeof(std::uint64_t);
constexpr std::size_t kDigestDigits = 32;

static_assert(std::endian::native == std::endian::little,
              "files hold numbers as they lie in memory");

std::string digest_of(std::string_view body) {
  Digest digest;
  digest.add(body);
  return digest.hex();
}

template <class T>
T value_at(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace

void save_tile_set(const std::filesystem::path& path, const TileSet& tiles) {
  const std::uint64_t body_bytes = TileSetCodec::size(tiles);
  AtomicFile file(path);
  file.write(kMagic);
  file.write_value(kVersion);
  file.write_value(body_bytes);
  // As `digest_of` the body.
  Digest digest;
  digest.add(body_bytes);
  TileSetCodec::write(tiles, [&](std::string_view piece) {
    digest.add_bytes(piece.data(), piece.size());
    file.write(piece);
  });
  file.write(digest.hex());
  file.commit();
}

TileSet load_tile_set(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const auto refuse = [&](std::string_view what) {
    return input_error(fmt::format("{}: {}", path.string(), what));
  };
  if (bytes.size() < kHeaderBytes || !is_tile_set(bytes))
    throw refuse("no tile set; `talus tiles -o FILE` makes one");
  const auto version = value_at<std::uint32_t>(bytes, kMagic.size());
  if (version != kVersion)
    throw refuse(fmt::format("tile set of format {}, but this version reads {}; make it again",
                             version, kVersion));
  const auto body_bytes = value_at<std::uint64_t>(bytes, kMagic.size() + sizeof kVersion);
  const std::size_t rest = bytes.size() - kHeaderBytes;
  if (rest < kDigestDigits || rest - kDigestDigits != body_bytes)
    throw refuse("tile set is cut off or has bytes appended; make it again");

  const std::string_view body = std::string_view(bytes).substr(kHeaderBytes, body_bytes);
  if (digest_of(body) != std::string_view(bytes).substr(kHeaderBytes + body_bytes))
    throw refuse("tile set is damaged, its checksum differs; make it again");
  try {
    return TileSetCodec::decode(body);
  } catch (const Error& error) {
    throw refuse(error.what());
  }
}

bool is_tile_set(std::string_view bytes) { return bytes.starts_with(kMagic); }

bool is_tile_set_file(const std::filesystem::path& path) {
  std::array<char, kMagic.size()> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  return is_tile_set({bytes.data(), bytes.size()});
}

}  // namespace talus
