#include "talus/io/mask_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "talus/base/error.h"
#include "talus/io/image_reader.h"

namespace talus {

namespace {

ColumnMask mask_of(const Image& image) {
  const int colors = std::min(image.channels, 3);
  ColumnMask mask{.nx = image.width, .ny = image.height};
  mask.shares.reserve(image.pixels.size() / static_cast<std::size_t>(image.channels));
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(x);
      int sum = 0;
      for (int c = 0; c < colors; ++c)
        sum += image.pixels[pixel * static_cast<std::size_t>(image.channels) +
                            static_cast<std::size_t>(c)];
      mask.shares.push_back(static_cast<float>(sum) / static_cast<float>(255 * colors));
    }
  return mask;
}

}  // namespace

ColumnMask read_mask(const std::filesystem::path& path, int nx, int ny) {
  return mask_of(read_image(path, [&](int width, int height) {
    if (width != nx || height != ny)
      throw usage_error(fmt::format(
          "{}: a mask of {} x {} pixels; it must have one for each column of the terrain, {} x {}",
          path.string(), width, height, nx, ny));
  }));
}

ColumnMask read_mask(const std::filesystem::path& path) { return mask_of(read_image(path)); }

}  // namespace talus
