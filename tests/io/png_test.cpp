#include "talus/io/png.h"

#include <gtest/gtest.h>

#include "io/scratch.h"

namespace talus {
namespace {

TEST(Png, RoundTripKeepsEveryByte) {
  const test::Scratch scratch;
  for (const int channels : {1, 3, 4}) {
    Image image{.width = 7, .height = 5, .channels = channels};
    for (int i = 0; i < 7 * 5 * channels; ++i)
      image.pixels.push_back(static_cast<std::uint8_t>(37 * i));
    write_png(scratch.path("a.png"), image);
    const Image read = read_png(scratch.path("a.png"));
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

TEST(Png, RefusesEveryTruncation) {
  const test::Scratch scratch;
  Image image{.width = 16, .height = 16, .channels = 3, .pixels = std::vector<std::uint8_t>(768)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i * i);
  write_png(scratch.path("a.png"), image);
  const std::string bytes = test::bytes_of(scratch.path("a.png"));
  // The last chunk (12 bytes) only says that the picture ends.
  for (std::size_t size = 0; size + 12 < bytes.size(); ++size) {
    const auto path = scratch.file("cut.png", bytes.substr(0, size));
    EXPECT_EQ(test::refusal_of([&] { read_png(path); }).kind, ErrorKind::input) << size;
  }
}

TEST(Png, RefusesPixelsThatDoNotFit) {
  const Image image{.width = 2, .height = 2, .channels = 3, .pixels = {1, 2, 3}};
  EXPECT_EQ(test::refusal_of([&] { encode_png(image); }).kind, ErrorKind::job);
}

}  // namespace
}  // namespace talus
