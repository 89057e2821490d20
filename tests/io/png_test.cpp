#include "talus/io/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include "io/scratch.h"

namespace talus {
namespace {

Image decoded(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return {};
  Image image{.width = static_cast<int>(png.width),
              .height = static_cast<int>(png.height),
              .channels = static_cast<int>(PNG_IMAGE_PIXEL_CHANNELS(png.format))};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr)) << png.message;
  return image;
}

TEST(Png, RoundTripKeepsEveryByte) {
  const test::Scratch scratch;
  for (const int channels : {1, 3, 4}) {
    Image image{.width = 7, .height = 5, .channels = channels};
    for (int i = 0; i < 7 * 5 * channels; ++i)
      image.pixels.push_back(static_cast<std::uint8_t>(37 * i));
    write_png(scratch.path("a.png"), image);
    const Image read = decoded(test::bytes_of(scratch.path("a.png")));
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

TEST(Png, RefusesPixelsThatDoNotFit) {
  const Image image{.width = 2, .height = 2, .channels = 3, .pixels = {1, 2, 3}};
  EXPECT_EQ(test::refusal_of([&] { encode_png(image); }).kind, ErrorKind::job);
}

}  // namespace
}  // namespace talus
