// OpenEXR pictures as GDAL data sets; GDAL itself may be built without that format.
#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <filesystem>

namespace talus {

// By its extension.
bool is_exr(const std::filesystem::path& path);

// The first part of the file, one band of floats for each channel: red, green, blue, the others in
// the order of their names, alpha last. Throws `Error`: (input) for a file that cannot be read,
// (job) if its channels would take more than `memory_limit` bytes.
GDALDatasetUniquePtr open_exr(const std::filesystem::path& path, std::uint64_t memory_limit);

}  // namespace talus
