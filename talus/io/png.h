// PNG pictures, in files and in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "talus/base/image.h"

namespace talus {

// The picture as a PNG stream; the same picture gives the same bytes on one build of libpng.
// Throws `Error` (job) if the picture has no pixels or a size that does not fit its pixels.
std::vector<std::byte> encode_png(const Image& image);

// Writes the picture; nothing half-written remains on error. Throws `Error` (job).
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace talus
