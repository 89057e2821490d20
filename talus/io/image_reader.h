// Pictures from other people's files.
#pragma once

#include <filesystem>
#include <functional>

#include "talus/base/image.h"

namespace talus {

// A PNG, a JPEG, or another picture with 8 or 16 bits a channel that GDAL reads. Numbers come out
// as they are stored, without a correction of gamma; of 16 bits the upper ones, rounded. Palettes
// are written out; the alpha of a grey picture is dropped.
//
// Throws `Error` (input) naming the file: missing, unreadable, malformed, cut off, other numbers of
// bits or channels, or more than 2^28 pixels. `check` is called before any pixel is read and may
// throw.
using CheckImageSize = std::function<void(int width, int height)>;
Image read_image(const std::filesystem::path& path, const CheckImageSize& check = {});

}  // namespace talus
