#include "talus/scene/pile_file.h"

#include <cstring>
#include <string>
#include <string_view>

#include "talus/base/hash.h"
#include "talus/io/atomic_file.h"
#include "talus/io/read_file.h"

namespace talus {
namespace {

// Layout, little-endian as every machine of the baseline: magic, the fields of `Pile` and of the
// mesh report in the order of `each_field`, the stones, and the hexadecimal digest of all before.
constexpr std::string_view kMagic = "TALUSPL1";
constexpr std::size_t kDigestSize = 32;

static_assert(sizeof(PlacedStone) == 16, "stones are stored as they lie in memory");

void each_field(auto& pile, auto& report, auto&& field) {
  for (int axis = 0; axis < 3; ++axis) field(pile.origin[axis]);
  field(pile.cell_size);
  field(pile.stats.instances);
  field(pile.stats.unique);
  field(pile.stats.hidden);
  field(pile.stats.isolated);
  field(pile.stats.contacts_mean);
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

std::string digest_of(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hex();
}

Error damaged(const std::string& name) { return input_error(name + ": no pile, or a damaged one"); }

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void value(T& to) { copy(&to, sizeof to); }
  void value(bool& to) {
    std::uint8_t byte = 0;
    value(byte);
    require(byte <= 1);
    to = byte == 1;
  }
  // All that is left.
  void stones(std::vector<PlacedStone>& to) {
    require(rest_.size() % sizeof(PlacedStone) == 0);
    to.resize(rest_.size() / sizeof(PlacedStone));
    copy(to.data(), rest_.size());
  }

 private:
  void require(bool condition) const {
    if (!condition) throw damaged(name_);
  }
  void copy(void* to, std::size_t size) {
    require(size <= rest_.size());
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  std::string_view rest_;
  const std::string& name_;
};

}  // namespace

void save_pile(const std::filesystem::path& path, const FilledSupport& filled) {
  std::string bytes(kMagic);
  const auto append = [&]<class T>(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(filled.mesh.has_value());
  const MeshSupportReport report = filled.mesh.value_or(MeshSupportReport{});
  each_field(filled.pile, report, append);
  bytes.append(reinterpret_cast<const char*>(filled.pile.stones.data()),
               filled.pile.stones.size() * sizeof(PlacedStone));

  AtomicFile file(path);
  file.write(bytes);
  file.write(digest_of(bytes));
  file.commit();
}

FilledSupport load_pile(const std::filesystem::path& path, std::shared_ptr<const TileSet> tiles) {
  const std::string name = path.string();
  const std::string file = read_file(path);
  const std::size_t size = file.size() < kDigestSize ? 0 : file.size() - kDigestSize;
  const std::string_view bytes = std::string_view(file).substr(0, size);
  if (!bytes.starts_with(kMagic) || std::string_view(file).substr(size) != digest_of(bytes))
    throw damaged(name);

  FilledSupport filled;
  Reader reader(bytes.substr(kMagic.size()), name);
  bool has_report = false;
  MeshSupportReport report;
  reader.value(has_report);
  each_field(filled.pile, report, [&](auto& value) { reader.value(value); });
  if (has_report) filled.mesh = report;
  reader.stones(filled.pile.stones);
  for (const PlacedStone& stone : filled.pile.stones)
    if (stone.stone >= tiles->stones().size())
      throw input_error(name + ": made of another tile set");
  filled.pile.tiles = std::move(tiles);
  return filled;
}

}  // namespace talus
