#include "talus/io/tile_set_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <unordered_map>

#include "talus/base/error.h"
#include "talus/rocks/colors.h"

namespace talus {
namespace {

// Reads, writes or counts, so that one list of fields serves all three.
class Writer {
 public:
  static constexpr bool kReading = false;
  explicit Writer(const TileSetCodec::Sink& sink) : sink_(sink) { buffer_.reserve(kBufferBytes); }

  template <class T>
  requires std::is_arithmetic_v<T>
  void value(const T& v) { bytes(&v, sizeof v); }
  template <class T>
  void list(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    bytes(v.data(), v.size() * sizeof(T));
  }
  std::uint64_t count(std::uint64_t n, std::size_t) {
    value(n);
    return n;
  }
  void finish() {
    sink_(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBufferBytes = 1 << 16;

  void bytes(const void* data, std::size_t size) {
    if (buffer_.size() + size > kBufferBytes) finish();
    const std::string_view piece(static_cast<const char*>(data), size);
    if (size > kBufferBytes)
      sink_(piece);
    else
      buffer_ += piece;
  }

  const TileSetCodec::Sink& sink_;
  std::string buffer_;  // small values, to be handed on together
};

// Tells how many bytes a `Writer` hands on.
class Sizer {
 public:
  static constexpr bool kReading = false;

  template <class T>
  requires std::is_arithmetic_v<T>
  void value(const T&) { bytes_ += sizeof(T); }
  template <class T>
  void list(const std::vector<T>& v) {
    bytes_ += sizeof(std::uint64_t) + v.size() * sizeof(T);
  }
  std::uint64_t count(std::uint64_t n, std::size_t) {
    value(n);
    return n;
  }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::uint64_t bytes_ = 0;
};

class Reader {
 public:
  static constexpr bool kReading = true;
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void value(T& v) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      value(byte);
      require(byte <= 1, "a flag is neither 0 nor 1");
      v = byte == 1;
    } else {
      copy(&v, sizeof v);
    }
  }
  template <class T>
  void list(std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    v.resize(count(0, sizeof(T)));
    copy(v.data(), v.size() * sizeof(T));
  }
  // A number of entries that take at least `entry_bytes` each.
  std::uint64_t count(std::uint64_t, std::size_t entry_bytes) {
    std::uint64_t n = 0;
    value(n);
    require(n <= bytes_.size() / entry_bytes, "a count is larger than what follows");
    return n;
  }
  bool at_end() const { return bytes_.empty(); }

  static void require(bool condition, std::string_view otherwise) {
    if (!condition) throw input_error(fmt::format("no sound tile set: {}", otherwise));
  }

 private:
  void copy(void* to, std::size_t size) {
    require(size <= bytes_.size(), "it ends too early");
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
};

template <class Archive, class Int3Like>
void vector(Archive& archive, Int3Like& v) {
  for (int axis = 0; axis < 3; ++axis) archive.value(v[axis]);
}

// Enumerations are numbered from 0 to their last value.
template <class Enum>
inline constexpr Enum kLast{};
template <>
inline constexpr Variety kLast<Variety> = Variety::periodic;
template <>
inline constexpr SeedPlacement kLast<SeedPlacement> = SeedPlacement::poisson;
template <>
inline constexpr Frames kLast<Frames> = Frames::bedded;

// Any field of a described parameter struct.
template <class Archive, class T>
void field(Archive& archive, T& v) {
  using Plain = std::remove_const_t<T>;
  if constexpr (std::is_arithmetic_v<Plain>) {
    archive.value(v);
  } else if constexpr (std::is_enum_v<Plain>) {
    auto number = static_cast<std::uint8_t>(v);
    archive.value(number);
    if constexpr (Archive::kReading) {
      Reader::require(number <= static_cast<std::uint8_t>(kLast<Plain>), "a choice is not known");
      v = static_cast<Plain>(number);
    }
  } else if constexpr (std::is_same_v<Plain, Range>) {
    archive.value(v.min);
    archive.value(v.max);
  } else if constexpr (std::is_same_v<Plain, Vec3>) {
    vector(archive, v);
  } else if constexpr (Described<Plain>) {
    Plain::describe(v, [&](auto& member, const Field&) { field(archive, member); });
  } else {
    bool given = v.has_value();
    archive.value(given);
    if constexpr (Archive::kReading)
      if (given) v.emplace();
    if (given) field(archive, *v);
  }
}

template <class Archive, class Mesh>
void mesh(Archive& archive, Mesh& m) {
  archive.list(m.positions);
  archive.list(m.normals);
  archive.list(m.triangles);
}

template <class Archive, class Contact>
void contact(Archive& archive, Contact& c) {
  vector(archive, c.cell);
  archive.value(c.seed);
  archive.value(c.kept);
  vector(archive, c.face);
}
constexpr std::size_t kContactBytes = 27;

// All of a stone but its mesh.
template <class Archive, class StoneLike>
void stone(Archive& archive, StoneLike& s) {
  vector(archive, s.cell);
  archive.value(s.seed);
  archive.value(s.colors);
  vector(archive, s.seed_position);
  vector(archive, s.pivot);
  archive.value(s.volume);
  archive.value(s.radius);
  archive.value(s.voxel_count);
  vector(archive, s.solid.min);
  vector(archive, s.solid.size);
  archive.list(s.solid.bits);
  const std::uint64_t contacts = archive.count(s.contacts.size(), kContactBytes);
  if constexpr (Archive::kReading) s.contacts.resize(contacts);
  for (auto& c : s.contacts) contact(archive, c);
}
constexpr std::size_t kStoneBytes = 134;  // without voxels and contacts, with its mesh's number

template <class Archive, class Stats>
void statistics(Archive& archive, Stats& s) {
  archive.value(s.empty);
  archive.value(s.distinct_meshes);
  archive.value(s.fragments_removed);
  archive.value(s.seed_spacing);
  archive.value(s.deviation_bound);
  field(archive, s.sufficient_n);
  archive.value(s.void_fraction);
  archive.value(s.contacts_mean);
  archive.value(s.contacts_min);
  archive.value(s.contacts_lost_fraction);
  archive.value(s.below_three_fraction);
  archive.value(s.triangles);
}

constexpr std::uint32_t kNoMesh = 0xffffffffu;

void check_stone_mesh(const TriangleMesh& m) {
  const auto vertices = static_cast<std::uint32_t>(m.positions.size());
  Reader::require(!m.triangles.empty(), "a mesh has no triangle");
  for (const Vec3f& p : m.positions)
    Reader::require(std::isfinite(p.x + p.y + p.z), "a mesh has a vertex that is nowhere");
  Reader::require(m.normals.empty() || m.normals.size() == m.positions.size(),
                  "a mesh has not one normal per vertex");
  for (const Triangle& t : m.triangles)
    Reader::require(t.x < vertices && t.y < vertices && t.z < vertices,
                    "a triangle uses a vertex that is not there");
}

void check_solid(const StoneSolid& solid) {
  std::uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    Reader::require(solid.size[axis] >= 0 && solid.size[axis] <= 4096, "a solid has no sound size");
    voxels *= static_cast<std::uint64_t>(solid.size[axis]);
  }
  Reader::require(solid.bits.size() == (voxels + 63) / 64, "a solid has not one bit per voxel");
}

// What `stones_of` relies on: for every cell and all colors it depends on there is a run, and runs
// cover the stones in order.
void check_runs(const TileParams& params, const std::vector<std::uint32_t>& run_first,
                const std::vector<std::uint32_t>& cell_runs, std::size_t stones) {
  const rocks::CellLayout layout(params);
  Reader::require(cell_runs.size() == layout.cell_count(), "it has not one list of runs per cell");
  std::uint64_t runs = 0;
  for (std::size_t cell = 0; cell < cell_runs.size(); ++cell) {
    Reader::require(cell_runs[cell] == runs, "the runs of a cell are not where they should be");
    runs += rocks::code_count(layout.stone_corners(layout.cell_at(cell)), layout.colors);
  }
  Reader::require(run_first.size() == runs + 1, "it has not one run per coloring of a cell");
  Reader::require(std::is_sorted(run_first.begin(), run_first.end()) && run_first.front() == 0 &&
                      run_first.back() == stones,
                  "runs of stones do not cover the stones in order");
}

}  // namespace

template <class Archive>
void TileSetCodec::list(Archive& out, const TileSet& tiles) {
  field(out, tiles.params_);
  out.value(tiles.seed_);

  // Meshes are numbered in the order in which stones first use them.
  std::unordered_map<const TriangleMesh*, std::uint32_t> number;
  std::vector<const TriangleMesh*> meshes;
  for (const Stone& s : tiles.stones_)
    if (s.mesh && number.emplace(s.mesh.get(), static_cast<std::uint32_t>(meshes.size())).second)
      meshes.push_back(s.mesh.get());
  out.value(static_cast<std::uint64_t>(meshes.size()));
  for (const TriangleMesh* m : meshes) mesh(out, *m);

  out.value(static_cast<std::uint64_t>(tiles.stones_.size()));
  for (const Stone& s : tiles.stones_) {
    stone(out, s);
    out.value(s.mesh ? number.at(s.mesh.get()) : kNoMesh);
  }
  out.list(tiles.run_first_);
  out.list(tiles.cell_runs_);
  out.value(tiles.reach_);
  statistics(out, tiles.stats_);
}

std::uint64_t TileSetCodec::size(const TileSet& tiles) {
  Sizer sizer;
  list(sizer, tiles);
  return sizer.bytes();
}

void TileSetCodec::write(const TileSet& tiles, const Sink& sink) {
  Writer out(sink);
  list(out, tiles);
  out.finish();
}

TileSet TileSetCodec::decode(std::string_view bytes) {
  Reader in(bytes);
  TileSet tiles;
  field(in, tiles.params_);
  try {
    validate_tiles(tiles.params_);
  } catch (const Error& error) {
    Reader::require(false, error.what());
  }
  in.value(tiles.seed_);

  std::vector<std::shared_ptr<const TriangleMesh>> meshes(in.count(0, 3 * sizeof(std::uint64_t)));
  for (auto& shared : meshes) {
    auto made = std::make_shared<TriangleMesh>();
    mesh(in, *made);
    check_stone_mesh(*made);
    shared = std::move(made);
  }
  tiles.stones_.resize(in.count(0, kStoneBytes));
  for (Stone& s : tiles.stones_) {
    stone(in, s);
    check_solid(s.solid);
    std::uint32_t number = 0;
    in.value(number);
    Reader::require(number == kNoMesh || number < meshes.size(), "a stone's mesh is not there");
    if (number != kNoMesh) s.mesh = meshes[number];
  }
  in.list(tiles.run_first_);
  in.list(tiles.cell_runs_);
  check_runs(tiles.params_, tiles.run_first_, tiles.cell_runs_, tiles.stones_.size());
  in.value(tiles.reach_);
  Reader::require(tiles.reach_ >= 0 && tiles.reach_ <= tiles.params_.n,
                  "its stones reach farther than its cube");
  statistics(in, tiles.stats_);
  Reader::require(in.at_end(), "more bytes than it should have");
  return tiles;
}

}  // namespace talus
