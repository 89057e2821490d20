#include "talus/io/digest.h"

#include <cstddef>
#include <span>

#include "talus/io/tile_set_codec.h"

namespace talus {

// What an instance is called is no part of the scene.
constexpr std::size_t kInstanceBytes = offsetof(Instance, name);
static_assert(kInstanceBytes == sizeof(Vec3) + sizeof(Quat) + sizeof(float) + sizeof(std::uint32_t),
              "instances are digested as bytes and must have no padding");

void add_to(Digest& digest, const TriangleMesh& mesh) {
  digest.add(std::span(mesh.positions));
  digest.add(std::span(mesh.normals));
  digest.add(std::span(mesh.triangles));
  if (!mesh.shares.empty()) digest.add(std::span(mesh.shares));
}

void add_to(Digest& digest, const LayeredTerrain& terrain) {
  const TerrainGrid& grid = terrain.grid();
  for (const int value : {grid.nx, grid.ny, grid.floor}) digest.add(value);
  for (const double value : {grid.cell, grid.step, grid.origin_x, grid.origin_y}) digest.add(value);
  for (int y = 0; y < grid.ny; ++y)
    for (int x = 0; x < grid.nx; ++x) digest.add(terrain.column(x, y));
}

void add_to(Digest& digest, const InstanceTable& table) {
  digest.add(static_cast<std::uint64_t>(table.prototypes.size()));
  for (const auto& prototype : table.prototypes) add_to(digest, *prototype);
  digest.add(static_cast<std::uint64_t>(table.instances.size()));
  for (const Instance& instance : table.instances) digest.add_bytes(&instance, kInstanceBytes);
}

void add_to(Digest& digest, const TileSet& tiles) {
  digest.add(TileSetCodec::size(tiles));
  TileSetCodec::write(
      tiles, [&](std::string_view piece) { digest.add_bytes(piece.data(), piece.size()); });
}

}  // namespace talus
