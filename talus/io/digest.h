// Fingerprints of scene data: equal data, equal digests, whatever made it.
#pragma once

#include "talus/base/hash.h"
#include "talus/mesh/instance_table.h"
#include "talus/rocks/tile_set.h"
#include "talus/terrain/layered_terrain.h"

namespace talus {

void add_to(Digest& digest, const TriangleMesh& mesh);
// The grid and every column.
void add_to(Digest& digest, const LayeredTerrain& terrain);
// Prototypes by their content, then the instances.
void add_to(Digest& digest, const InstanceTable& table);
// Everything a tile set file holds.
void add_to(Digest& digest, const TileSet& tiles);

}  // namespace talus
