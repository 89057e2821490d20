// A part of a column filled with a material.
#pragma once

#include "talus/terrain/layered_terrain.h"

namespace talus {

// What lies between two heights and is one of the materials that may be replaced becomes another.
void fill_run(ColumnEditor& column, Steps bottom, Steps top, Material material,
              const MaterialSet& replaces);

}  // namespace talus
