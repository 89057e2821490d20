#include "talus/io/png.h"

#include <fmt/format.h>
#include <png.h>

#include "talus/base/error.h"
#include "talus/io/atomic_file.h"

namespace talus {
namespace {

png_uint_32 png_format(int channels) {
  return channels == 1 ? PNG_FORMAT_GRAY : channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
}

}  // namespace

std::vector<std::byte> encode_png(const Image& image) {
  const auto expected = static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height) *
                        static_cast<std::size_t>(image.channels);
  if (expected == 0 || expected != image.pixels.size())
    throw job_error(fmt::format("picture of {} x {} x {} has {} bytes", image.width, image.height,
                                image.channels, image.pixels.size()));

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = png_format(image.channels);
  png.flags = PNG_IMAGE_FLAG_FAST;  // a third larger, in a quarter of the time

  std::vector<std::byte> out(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = out.size();
  if (!png_image_write_to_memory(&png, out.data(), &size, 0, image.pixels.data(), 0, nullptr))
    throw job_error(fmt::format("picture cannot be encoded: {}", png.message));
  out.resize(size);
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::byte> bytes = encode_png(image);
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace talus
