// Where stones are, without their shapes.
#pragma once

#include <filesystem>

#include "talus/base/job.h"
#include "talus/mesh/instance_table.h"

namespace talus {

// Both write a row for each instance in the table's order: its position x, y, z in metres, z up;
// its rotation as a unit quaternion qx, qy, qz, qw; its scale; the number of its prototype,
// `shape`; and its name, `cell_x`, `cell_y`, `cell_z`, `seed`, `pile`, by which a recipe's
// `removed`, `locked` and `moved` know a stone. Prototype k is `stones/<k>` in GLB, `stone_<k>` in
// USD. Numbers read back are the table's own. Throw `Error` (job) if the file cannot be written.

// A vertex for each instance, binary little-endian; positions are double, the rest float and uint.
void write_points(const std::filesystem::path& path, const InstanceTable& stones,
                  Job* job = nullptr);

// Text with a first line of names.
void write_csv(const std::filesystem::path& path, const InstanceTable& stones, Job* job = nullptr);

}  // namespace talus
