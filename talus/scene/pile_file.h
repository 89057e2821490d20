// A pile as the cache keeps it: which stones of its tile set stand where.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "talus/field/mesh_support.h"
#include "talus/piles/pile.h"

namespace talus {

// A filled support, with what was found about it if it is a mesh.
struct FilledSupport {
  Pile pile;
  std::optional<MeshSupportReport> mesh;
};

// Writes all but the tile set. Throws `Error` (job).
void save_pile(const std::filesystem::path& path, const FilledSupport& filled);

// Reads what `save_pile` wrote about a pile of `tiles`. Throws `Error` (input) if the file is
// missing, cut off, changed by a single bit, or names stones that `tiles` does not have.
FilledSupport load_pile(const std::filesystem::path& path, std::shared_ptr<const TileSet> tiles);

}  // namespace talus
