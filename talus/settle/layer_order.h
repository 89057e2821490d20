// Deposits in the order in which nature lays them.
#pragma once

#include "talus/terrain/layered_terrain.h"

namespace talus {

// Sorts the deposits of each column, between bedrock and bedrock or sky: sand, soil, rocks, water,
// ice, snow, then air under a roof; bedrock stays ([Peytavie2010] §2.1.1.2). Sorting is no change
// of matter and is not booked.
//
// Then matter that cannot lie where it does gives way. Snow directly on water, without ice between,
// falls in and becomes water of the same mass. Less than a step is left over, which is carried to
// the next column of the same tile, so that a tile loses less than one step of water. The thesis
// takes that snow away; here it is booked as a conversion.
//
// Sorting what is sorted changes nothing. Returns what was booked.
Booking sort_layers(LayeredTerrain& terrain, const ColumnArea& area, Job* job = nullptr);
Booking sort_layers(LayeredTerrain& terrain, Job* job = nullptr);

}  // namespace talus
