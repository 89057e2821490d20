// Heights where none are known.
#pragma once

#include "talus/base/job.h"
#include "talus/field/height_grid.h"

namespace talus {

// Gives every cell without a height that of a membrane between the known ones: each becomes the
// mean of its four neighbors to within a millimetre a sweep, borders of the grid being free. Known
// heights stay. A grid without a known height stays as it is.
void fill_holes(HeightGrid& grid, Job* job = nullptr);

}  // namespace talus
