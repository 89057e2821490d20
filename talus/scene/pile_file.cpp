#include "talus/scene/pile_file.h"

#include <span>
#include <string_view>
#include <utility>

#include "talus/scene/sealed_file.h"

namespace talus {
namespace {

// Layout: the fields of `Pile` and of the mesh report in the order of `each_field`, then the
// stones.
constexpr std::string_view kMagic = "TALUSPL2";

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

}  // namespace

void save_pile(const std::filesystem::path& path, const FilledSupport& filled) {
  SealedWriter writer(kMagic);
  writer.add(filled.mesh.has_value());
  const MeshSupportReport report = filled.mesh.value_or(MeshSupportReport{});
  each_field(filled.pile, report, [&](const auto& value) { writer.add(value); });
  writer.add_all(std::span(filled.pile.stones));
  writer.save(path);
}

FilledSupport load_pile(const std::filesystem::path& path, std::shared_ptr<const TileSet> tiles) {
  FilledSupport filled;
  SealedReader reader(path, kMagic);
  bool has_report = false;
  MeshSupportReport report;
  reader.read(has_report);
  each_field(filled.pile, report, [&](auto& value) { reader.read(value); });
  if (has_report) filled.mesh = report;
  filled.pile.stones = reader.read_rest<PlacedStone>();
  for (const PlacedStone& stone : filled.pile.stones)
    if (stone.stone >= tiles->stones().size())
      throw input_error(path.string() + ": made of another tile set");
  filled.pile.tiles = std::move(tiles);
  return filled;
}

}  // namespace talus
