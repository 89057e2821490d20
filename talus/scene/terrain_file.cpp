#include "talus/scene/terrain_file.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "talus/scene/sealed_file.h"

namespace talus {
namespace {

// Layout: the grid, the booking, and the columns, row by row: the number of their layers, then
// these.
constexpr std::string_view kMagic = "TALUSTR1";

void each_field(auto& grid, auto&& field) {
  field(grid.nx);
  field(grid.ny);
  field(grid.cell);
  field(grid.step);
  field(grid.origin_x);
  field(grid.origin_y);
  field(grid.floor);
}

}  // namespace

void save_terrain(const std::filesystem::path& path, const TerrainStage& stage) {
  SealedWriter writer(kMagic);
  const TerrainGrid& grid = stage.terrain.grid();
  each_field(grid, [&](const auto& value) { writer.add(value); });
  writer.add(stage.booking);
  writer.add(stage.balanced);
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x) {
      const std::span<const Layer> layers = stage.terrain.column(x, y);
      writer.add(static_cast<std::uint32_t>(layers.size()));
      writer.add_all(layers);
    }
  writer.save(path);
}

TerrainStage load_terrain(const std::filesystem::path& path) {
  SealedReader reader(path, kMagic);
  TerrainGrid grid;
  each_field(grid, [&](auto& value) { reader.read(value); });
  Booking booking;
  bool balanced = false;
  reader.read(booking);
  reader.read(balanced);

  // Where each column's run begins.
  const std::vector<std::uint32_t> words = reader.read_rest<std::uint32_t>();
  std::vector<std::size_t> begins;
  std::size_t next = 0;
  for (std::int64_t i = 0; i < std::int64_t{grid.nx} * grid.ny; ++i) {
    reader.require(next < words.size() && words[next] < words.size() - next);
    begins.push_back(next);
    Steps bottom = grid.floor;
    for (std::uint32_t k = 1; k <= words[next]; ++k) {
      const auto layer = std::bit_cast<Layer>(words[next + k]);
      reader.require(layer.top() > bottom && static_cast<int>(layer.material()) < kMaterialCount);
      bottom = layer.top();
    }
    next += 1 + std::size_t{words[next]};
  }
  reader.require(next == words.size());

  LayeredTerrain terrain(grid);
  terrain.edit([&](int x, int y, ColumnEditor& column) {
    const std::size_t begin =
        begins[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.nx) +
               static_cast<std::size_t>(x)];
    Steps bottom = grid.floor;
    for (std::size_t i = 1; i <= words[begin]; ++i) {
      const auto layer = std::bit_cast<Layer>(words[begin + i]);
      column.replace(bottom, layer.top(), layer.material());
      bottom = layer.top();
    }
  });
  return {std::move(terrain), booking, balanced};
}

}  // namespace talus
