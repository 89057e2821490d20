#include "talus/io/digest.h"

#include <span>

#include "talus/io/tile_set_codec.h"

namespace talus {

static_assert(sizeof(Instance) ==
                  sizeof(Vec3) + sizeof(Quat) + sizeof(float) + sizeof(std::uint32_t),
              "instances are digested as bytes and must have no padding");

void add_to(Digest& digest, const TriangleMesh& mesh) {
  digest.add(std::span(mesh.positions));
  digest.add(std::span(mesh.normals));
  digest.add(std::span(mesh.triangles));
}

void add_to(Digest& digest, const InstanceTable& table) {
  digest.add(static_cast<std::uint64_t>(table.prototypes.size()));
  for (const auto& prototype : table.prototypes) add_to(digest, *prototype);
  digest.add(std::span(table.instances));
}

void add_to(Digest& digest, const TileSet& tiles) { digest.add(TileSetCodec::encode(tiles)); }

}  // namespace talus
